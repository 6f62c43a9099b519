/* What the FMI functions know of a model: its variables, constants and one entry.
   The tables behind these declarations are generated from the list of FMI variables. */
#ifndef GEARLUBE_MODEL_H
#define GEARLUBE_MODEL_H

#include <stdint.h>

#include "model_sizes.h"

/* FMI 2 reads and sets an enumeration as an integer. */
typedef enum { GL_REAL, GL_INTEGER, GL_BOOLEAN } gl_kind;
typedef enum { GL_PARAMETER, GL_INPUT, GL_OUTPUT } gl_causality;

typedef struct {
    const char *name;
    const char *unit;            /* "" for numbers without one */
    const char *const *literals; /* of an enumeration, from value 1 on; else NULL */
    double start, low, high;     /* closed range of legal values [unit] */
    gl_kind kind;
    gl_causality causality;
    int place; /* among parameters, inputs or outputs of the model; -1: an option by number */
    int option; /* of an option by number: reference of the enumeration it stands for; else -1 */
    int needs;  /* before it is read: 0 nothing, 1 the outputs of the motion, 2 all outputs */
} gl_variable;

/* A variable of FMI 3: an array where FMI 2 has one variable for each element. */
typedef struct {
    int count;               /* of elements; 0: FMI 3 has no variable of this reference */
    const unsigned *members; /* their references in FMI 2 */
} gl_array;

typedef struct {
    int status;
    const char *text;
} gl_refusal;

typedef struct {
    const char *output; /* name of the output that holds the value */
    const char *what;   /* in words */
    const char *unit;
    const char *beyond; /* a sentence: what is computed there, and the cure */
    int reference;      /* of the output */
} gl_range;

extern const gl_variable gl_variables[GL_VARIABLES];
extern const gl_array gl_arrays[GL_VARIABLES];
extern const int gl_inputs[GL_INPUTS];   /* reference of each input of the model */
extern const int gl_outputs[GL_OUTPUTS]; /* reference of each output of the model */
extern const gl_refusal gl_refusals[GL_REFUSALS];
extern const gl_range gl_ranges[GL_RANGES];
extern const double gl_data[]; /* what only a table or a gear decides */

enum { GL_START, GL_STEP, GL_WRITE_OUTPUTS, GL_RESUME, GL_MOTION }; /* operations of the entry */

/* The physics: compiled from the same kernels as the Python models. Returns 0 or the status of a
   refusal, with `state` unchanged. It allocates nothing and takes no lock. */
int64_t gearlube_entry(int64_t operation, double step, const double *data,
                       const double *parameters, const double *inputs, double *state, double *work,
                       double *outputs);

#endif
