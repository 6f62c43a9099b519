/* A small FMI 2.0 host: host LIBRARY GUID H STEPS {r|i}REFERENCE=VALUE... oREFERENCE...

   Sets Reals (r) and Integers (i) before the initialisation, makes STEPS steps of H seconds and
   prints the Reals asked for (o), one a line. Builds on Linux, macOS and Windows. */

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#define OPEN(path) ((void *)LoadLibraryA(path))
#define FIND(library, name) ((void *)GetProcAddress((HMODULE)(library), name))
#else
#include <dlfcn.h>
#define OPEN(path) dlopen(path, RTLD_NOW | RTLD_LOCAL)
#define FIND(library, name) dlsym(library, name)
#endif

#include "fmi2FunctionTypes.h"

enum { BEFORE = 5 };

static void *library;

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                   fmi2String category, fmi2String message, ...) {
  va_list arguments;
  (void)environment, (void)instance, (void)category;
  if (status == fmi2OK) return;
  va_start(arguments, message);
  vfprintf(stderr, message, arguments);
  va_end(arguments);
  fputc('\n', stderr);
}

static const fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};

static void *function(const char *name) {
  void *found = FIND(library, name);
  if (!found) {
    fprintf(stderr, "no %s\n", name);
    exit(3);
  }
  return found;
}

#define CALL(name) ((name##TYPE *)function(#name))

static void check(fmi2Status status, const char *what) {
  if (status == fmi2OK) return;
  fprintf(stderr, "%s: status %d\n", what, status);
  exit(4);
}

static void set(fmi2Component instance, const char *text) {
  char *rest;
  const fmi2ValueReference reference = (fmi2ValueReference)strtoul(text + 1, &rest, 10);
  const double real = atof(rest + 1);
  const int integer = (int)real;
  if (*text == 'r') check(CALL(fmi2SetReal)(instance, &reference, 1, &real), text);
  if (*text == 'i') check(CALL(fmi2SetInteger)(instance, &reference, 1, &integer), text);
}

int main(int count, char **argument) {
  if (count < BEFORE) return 1;
  library = OPEN(argument[1]);
  if (!library) {
    fprintf(stderr, "%s cannot be loaded\n", argument[1]);
    return 2;
  }
  const double h = atof(argument[3]);
  const int steps = atoi(argument[4]);
  fmi2Component instance = CALL(fmi2Instantiate)("pair", fmi2CoSimulation, argument[2], "",
                                                 &callbacks, fmi2False, fmi2True);
  if (!instance) return 5;
  check(CALL(fmi2SetupExperiment)(instance, 0, 0.0, 0.0, 0, 0.0), "fmi2SetupExperiment");
  for (int i = BEFORE; i < count; i++) set(instance, argument[i]);
  check(CALL(fmi2EnterInitializationMode)(instance), "fmi2EnterInitializationMode");
  check(CALL(fmi2ExitInitializationMode)(instance), "fmi2ExitInitializationMode");
  for (int step = 0; step < steps; step++)
    check(CALL(fmi2DoStep)(instance, step * h, h, fmi2True), "fmi2DoStep");
  for (int i = BEFORE; i < count; i++) {
    const fmi2ValueReference reference = (fmi2ValueReference)atoi(argument[i] + 1);
    double value;
    if (*argument[i] != 'o') continue;
    check(CALL(fmi2GetReal)(instance, &reference, 1, &value), argument[i]);
    printf("%.17g\n", value);
  }
  check(CALL(fmi2Terminate)(instance), "fmi2Terminate");
  CALL(fmi2FreeInstance)(instance);
  return 0;
}
