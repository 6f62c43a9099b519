/* A host that is not Python: native_host ENDING STEPS H {LIBRARY RESOURCES GUID REFERENCE}...

   Steps two instances of every FMU in turn by H seconds, reads one Real after each step, prints the
   last, and on stderr the processor time of all steps, and ends
   free:  after fmi2FreeInstance
   close: after fmi2FreeInstance and dlclose
   leave: with its instances running. */

#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmi2FunctionTypes.h"

enum { INSTANCES = 2, MOST = 4 };
typedef struct {
  void *library;
  fmi2Component instances[INSTANCES];
  fmi2ValueReference reference;
  double values[INSTANCES];
} Fmu;

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                   fmi2String category, fmi2String message, ...) {
  va_list arguments;
  if (status == fmi2OK) return;
  va_start(arguments, message);
  vfprintf(stderr, message, arguments);
  va_end(arguments);
  fputc('\n', stderr);
}

static const fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};

static void *function(const Fmu *fmu, const char *name) {
  void *found = dlsym(fmu->library, name);
  if (found == NULL) {
    fprintf(stderr, "no %s\n", name);
    exit(3);
  }
  return found;
}

#define CALL(fmu, name) ((name##TYPE *)function(fmu, #name))

static void check(fmi2Status status, const char *what) {
  if (status == fmi2OK) return;
  fprintf(stderr, "%s: status %d\n", what, status);
  exit(4);
}

static void start(Fmu *fmu, char **argument) {
  fmu->library = dlopen(argument[0], RTLD_NOW | RTLD_LOCAL);
  if (fmu->library == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    exit(2);
  }
  fmu->reference = (fmi2ValueReference)atoi(argument[3]);
  for (int i = 0; i < INSTANCES; i++) {
    fmi2Component instance = CALL(fmu, fmi2Instantiate)(
        "pair", fmi2CoSimulation, argument[2], argument[1], &callbacks, fmi2False, fmi2True);
    if (instance == NULL) exit(5);
    fmu->instances[i] = instance;
    check(CALL(fmu, fmi2SetupExperiment)(instance, 0, 0.0, 0.0, 0, 0.0), "fmi2SetupExperiment");
    check(CALL(fmu, fmi2EnterInitializationMode)(instance), "fmi2EnterInitializationMode");
    check(CALL(fmu, fmi2ExitInitializationMode)(instance), "fmi2ExitInitializationMode");
  }
}

static void step_and_read(Fmu *fmu, double time, double h) {
  fmi2DoStepTYPE *step = CALL(fmu, fmi2DoStep);
  fmi2GetRealTYPE *read = CALL(fmu, fmi2GetReal);
  for (int i = 0; i < INSTANCES; i++) {
    check(step(fmu->instances[i], time, h, fmi2True), "fmi2DoStep");
    check(read(fmu->instances[i], &fmu->reference, 1, &fmu->values[i]), "fmi2GetReal");
  }
}

static void end(Fmu *fmu) {
  for (int i = 0; i < INSTANCES; i++) {
    check(CALL(fmu, fmi2Terminate)(fmu->instances[i]), "fmi2Terminate");
    CALL(fmu, fmi2FreeInstance)(fmu->instances[i]);
  }
}

int main(int count, char **argument) {
  enum { BEFORE = 4, EACH = 4 };
  Fmu fmus[MOST];
  const int n = (count - BEFORE) / EACH;
  if (n < 1 || n > MOST || (count - BEFORE) % EACH) return 1;
  const char *ending = argument[1];
  const int steps = atoi(argument[2]);
  const double h = atof(argument[3]);
  for (int k = 0; k < n; k++) start(&fmus[k], argument + BEFORE + EACH * k);
  const clock_t began = clock();
  for (int step = 0; step < steps; step++)
    for (int k = 0; k < n; k++) step_and_read(&fmus[k], step * h, h);
  fprintf(stderr, "steps: %g s\n", (double)(clock() - began) / CLOCKS_PER_SEC);
  for (int k = 0; k < n; k++) {
    for (int i = 0; i < INSTANCES; i++) printf("%.17g\n", fmus[k].values[i]);
    if (strcmp(ending, "leave")) end(&fmus[k]);
    if (!strcmp(ending, "close")) dlclose(fmus[k].library);
  }
  return 0;
}
