/* Runs RotatingMass by FMI 2 and FMI 3 and writes its outputs: small_host LIBRARY GUID */
#include "fmi2Functions.h"
#include "fmi3Functions.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef _WIN32
#include <windows.h>
#define OPEN(path) LoadLibraryA(path)
#define FIND(library, name) ((void *)GetProcAddress(library, name))
#else
#include <dlfcn.h>
#define OPEN(path) dlopen(path, RTLD_NOW)
#define FIND(library, name) dlsym(library, name)
#endif

enum { STEPS = 500, OUTPUTS = 4, FIRST_OUTPUT = 9 };
static const double STEP = 1.0 / 1024.0;

static void log_2(void *host, fmi2String name, fmi2Status status, fmi2String category,
                 fmi2String message, ...)
{
    (void)host;
    printf("log %s %d %s %s\n", name, status, category, message);
}

static void log_3(fmi3InstanceEnvironment host, fmi3Status status, fmi3String category,
                 fmi3String message)
{
    (void)host;
    printf("log %d %s %s\n", status, category, message);
}

static void check(int status, int expected, const char *what)
{
    if (status != expected) {
        printf("%s: %d\n", what, status);
        exit(1);
    }
}

static void print(const double *outputs)
{
    printf("outputs %.17g %.17g %.17g %.17g\n", outputs[0], outputs[1], outputs[2], outputs[3]);
}

/* The call of a function of either version, found by its name. */
#define CALL2(name) ((name##TYPE *)FIND(library, #name))
#define CALL3 CALL2

int main(int count, char **arguments)
{
    if (count != 3) {
        return 2;
    }
    void *library = (void *)OPEN(arguments[1]);
    if (!library) {
        printf("cannot be loaded\n");
        return 1;
    }
    const unsigned outputs[OUTPUTS] = {FIRST_OUTPUT, FIRST_OUTPUT + 1, FIRST_OUTPUT + 2,
                                       FIRST_OUTPUT + 3};
    const unsigned torque = 0;
    double values[OUTPUTS];
    fmi2CallbackFunctions calls = {log_2, NULL, NULL, NULL, NULL};

    check(CALL2(fmi2Instantiate)("m", fmi2CoSimulation, "wrong", "", &calls, 0, 0) != NULL, 0,
          "wrong GUID");
    void *m = CALL2(fmi2Instantiate)("m", fmi2CoSimulation, arguments[2], "", &calls, 0, 1);
    check(CALL2(fmi2SetupExperiment)(m, 0, 0.0, 0.0, 0, 0.0), fmi2OK, "setup");
    check(CALL2(fmi2EnterInitializationMode)(m), fmi2OK, "enter");
    check(CALL2(fmi2ExitInitializationMode)(m), fmi2OK, "exit");
    for (int i = 0; i < STEPS; i++) {
        double now = 5.0 * sin(0.01 * i);
        check(CALL2(fmi2SetReal)(m, &torque, 1, &now), fmi2OK, "set");
        check(CALL2(fmi2DoStep)(m, i * STEP, STEP, 1), fmi2OK, "step");
    }
    check(CALL2(fmi2GetReal)(m, outputs, OUTPUTS, values), fmi2OK, "get");
    print(values);
    double bad = NAN;
    check(CALL2(fmi2SetReal)(m, &torque, 1, &bad), fmi2Warning, "bad value");
    check(CALL2(fmi2DoStep)(m, STEPS * STEP, STEP, 1), fmi2Discard, "bad step");
    check(CALL2(fmi2Terminate)(m), fmi2OK, "terminate");
    CALL2(fmi2FreeInstance)(m);

    m = CALL3(fmi3InstantiateCoSimulation)("m", arguments[2], NULL, false, true, false, false, NULL,
                                           0, NULL, log_3, NULL);
    check(CALL3(fmi3EnterInitializationMode)(m, false, 0.0, 0.0, false, 0.0), fmi3OK, "enter");
    check(CALL3(fmi3ExitInitializationMode)(m), fmi3OK, "exit");
    for (int i = 0; i < STEPS; i++) {
        double now = 5.0 * sin(0.01 * i), last;
        bool event, end, early;
        check(CALL3(fmi3SetFloat64)(m, &torque, 1, &now, 1), fmi3OK, "set");
        check(CALL3(fmi3DoStep)(m, i * STEP, STEP, true, &event, &end, &early, &last), fmi3OK,
              "step");
    }
    check(CALL3(fmi3GetFloat64)(m, outputs, OUTPUTS, values, OUTPUTS), fmi3OK, "get");
    print(values);
    CALL3(fmi3FreeInstance)(m);
    return 0;
}
