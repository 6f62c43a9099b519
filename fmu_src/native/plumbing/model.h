/* What the FMI functions know of a model: its variables, constants and one entry.
   What the entry is compiled for stands in `model_sizes.h`, generated from the list of FMI variables.
   All other numbers and all words come from the file `resources/model.bin` of the FMU. */
#ifndef GEARLUBE_MODEL_H
#define GEARLUBE_MODEL_H

#include <stdint.h>

#include "model_sizes.h"

/* FMI 2 reads and sets an enumeration as an integer. */
typedef enum { GL_REAL, GL_INTEGER, GL_BOOLEAN } gl_kind;
/* What is computed before a variable is read, as bits; all that the model computes is all of them. */
enum {
    GL_NOTHING = 0,
    GL_OF_MOTION = 1,
    GL_OF_RATES = 2,
    GL_OF_FLANKS = 4,
    GL_OF_BEARINGS = 8,
    GL_OF_OUTPUTS = 16,
    GL_ALL = 31
};
typedef enum { GL_PARAMETER, GL_INPUT, GL_OUTPUT } gl_causality;

typedef struct {
    const char *name;
    const char *unit;            /* "" for numbers without one */
    const char *const *literals; /* of an enumeration, from value 1 on; else NULL */
    double start, low, high;     /* closed range of legal values [unit] */
    double nominal;              /* typical size [unit] */
    gl_kind kind;
    gl_causality causality;
    int place; /* among parameters, inputs or outputs of the model; -1: an option by number */
    int option; /* of an option by number: reference of the enumeration it stands for; else -1 */
    int needs;  /* one of GL_NOTHING to GL_OF_OUTPUTS */
} gl_variable;

/* A variable of FMI 3: an array where FMI 2 has one variable for each element. */
typedef struct {
    int count;               /* of elements; 0: FMI 3 has no variable of this reference */
    const unsigned *members; /* their references in FMI 2 */
} gl_array;

/* A continuous state. */
typedef struct {
    int reference, rate; /* of the variables that hold it and its derivative */
    int place;           /* in the model's state */
    double unit;         /* one in the model's state is so much in that of the variable */
} gl_continuous_state;

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

enum { GL_GUID_SIZE = 40 };

/* Sizes of a model. Those that arrays of instances are made for are at most GL_MOST_ of their name. */
typedef struct {
    int variables, parameters, inputs, outputs;
    int state, control_at; /* from this place on all values of a state are above 0 */
    int limits_at, ranges_at, ranges; /* places in `work`, and how many ranges */
    int continuous, indicators, inputs_at; /* place in the state */
    int exceeded; /* reference of range.exceeded */
} gl_sizes;

/* A model as its file describes it, in one piece of memory. */
typedef struct {
    char guid[GL_GUID_SIZE];
    gl_sizes n;
    int work, n_data, n_refusals;
    const gl_variable *variables; /* n.variables of them */
    const gl_array *arrays;       /* as many */
    const int *inputs;            /* reference of each input of the model */
    const int *outputs;           /* reference of each output of the model */
    const gl_continuous_state *states; /* n.continuous of them */
    const int *indicators;             /* references of the n.indicators event indicators */
    const gl_refusal *refusals;
    const gl_range *ranges; /* n.ranges of them */
    const double *data;     /* what only a table or a gear decides */
} gl_model;

/* operations of the entry */
enum {
    GL_START,
    GL_STEP,
    GL_WRITE_OUTPUTS,
    GL_RESUME,
    GL_MOTION,
    GL_DERIVATIVES,
    GL_EVENT,
    GL_SHOW, /* of the groups whose bits, as in `needs`, `step` sums up */
    GL_CHECK /* only of an entry that takes data of any length: `parameters` are the lengths of data
                and work and then gl_sizes, `inputs` how many options each parameter has */
};

/* The physics: compiled from the same kernels as the Python models. Returns 0 or the status of a
   refusal, with `state` unchanged. It allocates nothing and takes no lock. */
int64_t gearlube_entry(int64_t operation, double step, const double *data,
                       const double *parameters, const double *inputs, double *state, double *work,
                       double *outputs);

#if GL_EXCHANGE
/* The same of GL_WRITE_OUTPUTS and GL_DERIVATIVES, with the changes of the outputs along those of
   the state. The changes of `work` are scratch, zeros before the first call. */
int64_t gearlube_tangent(int64_t operation, double step, const double *data,
                         const double *parameters, const double *inputs, double *state,
                         double *work, double *outputs, double *of_state, double *of_work,
                         double *of_outputs);
#endif

#endif
