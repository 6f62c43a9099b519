/* native_calls {LIBRARY GUID REFERENCE H INTEGER VALUE}...: cost of the calls of FMUs of FMI 2.

   REFERENCE is that of the Real to read, INTEGER that of an Integer to set to VALUE before the start,
   or -1. Prints for each: load, first instance and initialisation [ms], the same again without
   loading [ms], reading one Real [ns], a step of H [us], median over TURNS turns through all FMUs,
   so that whatever slows the machine down slows down all. */

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "fmi2FunctionTypes.h"

enum { EACH = 6, MOST = 8, TURNS = 15, READS = 200000, STEPS = 2000 };
typedef struct {
    void *library;
    fmi2Component instance;
    fmi2ValueReference reference;
    double time, h, load, again[TURNS], read[TURNS], step[TURNS];
} Fmu;

static void quiet(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                  fmi2String category, fmi2String message, ...)
{
    (void)environment, (void)instance, (void)status, (void)category;
    fprintf(stderr, "%s\n", message);
}

static const fmi2CallbackFunctions callbacks = {quiet, calloc, free, NULL, NULL};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void *function(const Fmu *fmu, const char *name)
{
    void *found = dlsym(fmu->library, name);
    if (!found) {
        fprintf(stderr, "no %s\n", name);
        exit(3);
    }
    return found;
}

#define CALL(fmu, name) ((name##TYPE *)function(fmu, #name))

static void check(fmi2Status status, const char *what)
{
    if (status != fmi2OK) {
        fprintf(stderr, "%s: status %d\n", what, status);
        exit(4);
    }
}

static void start(Fmu *fmu, char **argument)
{
    const int integer = atoi(argument[4]), setting = atoi(argument[5]);
    fmu->instance = CALL(fmu, fmi2Instantiate)("one", fmi2CoSimulation, argument[1], "file:///",
                                               &callbacks, fmi2False, fmi2False);
    if (!fmu->instance) {
        exit(5);
    }
    if (integer >= 0) {
        const fmi2ValueReference place = (fmi2ValueReference)integer;
        check(CALL(fmu, fmi2SetInteger)(fmu->instance, &place, 1, &setting), "set");
    }
    check(CALL(fmu, fmi2SetupExperiment)(fmu->instance, 0, 0.0, 0.0, 0, 0.0), "setup");
    check(CALL(fmu, fmi2EnterInitializationMode)(fmu->instance), "enter");
    check(CALL(fmu, fmi2ExitInitializationMode)(fmu->instance), "exit");
    fmu->time = 0.0;
}

static void turn(Fmu *fmu, char **argument, int k)
{
    fmi2GetRealTYPE *read = CALL(fmu, fmi2GetReal);
    fmi2DoStepTYPE *step = CALL(fmu, fmi2DoStep);
    double value, begun = now();
    CALL(fmu, fmi2FreeInstance)(fmu->instance);
    start(fmu, argument);
    fmu->again[k] = now() - begun;
    begun = now();
    for (int i = 0; i < READS; i++) {
        check(read(fmu->instance, &fmu->reference, 1, &value), "read");
    }
    fmu->read[k] = (now() - begun) / READS;
    begun = now();
    for (int i = 0; i < STEPS; i++) {
        check(step(fmu->instance, fmu->time, fmu->h, fmi2True), "step");
        fmu->time += fmu->h;
    }
    fmu->step[k] = (now() - begun) / STEPS;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values)
{
    qsort(values, TURNS, sizeof *values, compare);
    return values[TURNS / 2];
}

int main(int count, char **argument)
{
    static Fmu fmus[MOST];
    const int n = (count - 1) / EACH;
    if (n < 1 || n > MOST || (count - 1) % EACH) {
        return 1;
    }
    for (int k = 0; k < n; k++) {
        char **own = argument + 1 + EACH * k;
        const double begun = now();
        fmus[k].library = dlopen(own[0], RTLD_NOW | RTLD_LOCAL);
        if (!fmus[k].library) {
            fprintf(stderr, "%s\n", dlerror());
            return 2;
        }
        fmus[k].reference = (fmi2ValueReference)atoi(own[2]);
        fmus[k].h = atof(own[3]);
        start(&fmus[k], own);
        fmus[k].load = now() - begun;
    }
    for (int turns = 0; turns < TURNS; turns++) {
        for (int k = 0; k < n; k++) {
            turn(&fmus[k], argument + 1 + EACH * k, turns);
        }
    }
    for (int k = 0; k < n; k++) {
        printf("%g %g %g %g\n", 1e3 * fmus[k].load, 1e3 * median(fmus[k].again),
               1e9 * median(fmus[k].read), 1e6 * median(fmus[k].step));
    }
    return 0;
}
