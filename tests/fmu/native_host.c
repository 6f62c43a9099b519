/* A host that is not Python: native_host ENDING STEPS {LIBRARY RESOURCES GUID REFERENCE}...

   Steps two instances of every FMU in turn, prints one Real of each, and ends
   free:  after fmi2FreeInstance
   close: after fmi2FreeInstance and dlclose
   leave: with its instances in place. */

#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2FunctionTypes.h"

enum { INSTANCES = 2, MOST = 4 };
static const double H = 1.0 / 1024.0; /* s */

typedef struct {
  void *library;
  fmi2Component instances[INSTANCES];
  fmi2ValueReference reference;
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

int main(int count, char **argument) {
  Fmu fmus[MOST];
  if (count < 7 || (count - 3) % 4 || (count - 3) / 4 > MOST) return 1;
  const int n = (count - 3) / 4, steps = atoi(argument[2]);
  const int leaves = !strcmp(argument[1], "leave"), closes = !strcmp(argument[1], "close");
  for (int k = 0; k < n; k++) start(&fmus[k], argument + 3 + 4 * k);
  for (int step = 0; step < steps; step++)
    for (int k = 0; k < n; k++)
      for (int i = 0; i < INSTANCES; i++)
        check(CALL(&fmus[k], fmi2DoStep)(fmus[k].instances[i], step * H, H, fmi2True),
              "fmi2DoStep");
  for (int k = 0; k < n; k++)
    for (int i = 0; i < INSTANCES; i++) {
      double value;
      check(CALL(&fmus[k], fmi2GetReal)(fmus[k].instances[i], &fmus[k].reference, 1, &value),
            "fmi2GetReal");
      printf("%.17g\n", value);
      check(CALL(&fmus[k], fmi2Terminate)(fmus[k].instances[i]), "fmi2Terminate");
      if (!leaves) CALL(&fmus[k], fmi2FreeInstance)(fmus[k].instances[i]);
    }
  for (int k = 0; k < n && closes; k++) dlclose(fmus[k].library);
  return 0;
}
