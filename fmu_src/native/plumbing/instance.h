/* An instance of the model: phases, values, refusals, messages and states, for FMI 2 and FMI 3. */
#ifndef GEARLUBE_INSTANCE_H
#define GEARLUBE_INSTANCE_H

#include <stddef.h>
#include <stdint.h>

#include "model.h"

/* Stepping is co-simulation; events and continuous time are model exchange. */
typedef enum {
    GL_INSTANTIATED,
    GL_INITIALISING,
    GL_STEPPING,
    GL_EVENTS,
    GL_CONTINUOUS_TIME,
    GL_TERMINATED
} gl_phase;

/* Values as FMI numbers them. A refused call changes nothing. */
typedef enum { GL_OK, GL_WARNING, GL_DISCARD, GL_ERROR } gl_status;

/* Categories of messages, in the order of the model description. */
typedef enum { GL_LOG_EVENTS, GL_LOG_WARNING, GL_LOG_DISCARD, GL_LOG_ERROR, GL_LOGS } gl_log;
extern const char *const gl_log_names[GL_LOGS];
#define GL_ALL_LOGS ((1u << GL_LOGS) - 1u)

typedef struct gl_instance gl_instance;

enum { GL_LONGEST_MESSAGE = 1024 };

/* Passes a message on to the host. */
typedef void (*gl_listener)(gl_instance *instance, gl_status status, const char *category,
                            const char *text);

/* Everything that a host may save and restore. */
typedef struct {
    gl_phase phase;
    int exchange;                /* 1: model exchange, 0: co-simulation */
    double time;                 /* last communication point, or what the host has set [s] */
    double values[GL_MOST_VARIABLES]; /* of every variable, in its FMI unit */
    double state[GL_MOST_STATE];      /* of the model */
} gl_snapshot;

/* Settings of floating point, in the registers of the processor. */
typedef struct {
#if defined(__x86_64__)
    uint32_t sse;
    uint16_t x87, x87_status;
#else
    uint64_t control, flags;
#endif
} gl_floats;

struct gl_instance {
    uint64_t mark; /* marks the memory of an instance */
    gl_floats host_floats; /* while a call of the host lasts */
    gl_model *model;
    gl_snapshot now;
    double stop; /* no step goes beyond it [s] */
    int stale;   /* outputs wait for a start with the present values */
    int step_refused; /* the last one; nothing has been restored since */
    int fresh;      /* what is computed of the present state, as bits */
    double watched; /* time at which the ranges were looked at last [s] */
    int refusals;                        /* values outside their range: how many, */
    unsigned char refused[GL_MOST_VARIABLES]; /* and which */
    double parameters[GL_MOST_PARAMETERS];    /* what `work` was made of */
    double outputs[GL_MOST_OUTPUTS];
    uint64_t points, outside[GL_MOST_RANGES + 1]; /* communication points, and those outside a range */
    unsigned logs;                           /* categories that the host wants, as bits */
    gl_listener listener;
    void *host;       /* what the listener needs of the host */
    uintptr_t logger; /* function of the host */
    char *name;
    int differentiated; /* since `work` was made of the parameters */
    double work[]; /* of the model; in model exchange, that of its tangent and its changes too */
};

/* Reads the model from the folder of the FMU's resources, given as a path or as a URI; NULL, and why
   not, if there is none for this library with this GUID. */
gl_model *gl_load(const char *resources, const char *guid, const char *name_of_guid,
                  char why[GL_LONGEST_MESSAGE]);

/* Takes over the model, also if there is no memory for an instance. */
gl_instance *gl_make(gl_model *model, const char *name, gl_listener listener, void *host,
                     uintptr_t logger, int logging, int exchange);
void gl_free(gl_instance *instance);
int gl_is_instance(const gl_instance *instance);

/* Begins a call of the host, with floating point as the model needs it; 0 if this is no instance. */
int gl_enter(gl_instance *instance);
/* Ends it, with floating point as the host had it; returns the status. */
gl_status gl_leave(gl_instance *instance, gl_status status);
#define GL_CALL(instance, call) (gl_enter(instance) ? gl_leave(instance, call) : GL_ERROR)

/* Says why no instance can be made, also on standard error. */
void gl_say_no_instance(const char *name, const char *text);

gl_status gl_choose_logs(gl_instance *instance, int on, size_t count, const char *const names[]);
void gl_say(gl_instance *instance, gl_status status, const char *text, ...);
gl_status gl_refuse(gl_instance *instance, const char *text, ...);

gl_status gl_set_times(gl_instance *instance, double start, double stop);
gl_status gl_enter_initialisation(gl_instance *instance);
gl_status gl_exit_initialisation(gl_instance *instance);
gl_status gl_terminate(gl_instance *instance);
gl_status gl_reset(gl_instance *instance);
gl_status gl_step(gl_instance *instance, double time, double step);

/* Check all of them first, so that a refused call changes nothing. `kind` is that of the call. */
gl_status gl_check_read(gl_instance *instance, gl_kind kind, size_t count, const unsigned *refs,
                        const void *values);
gl_status gl_check_set(gl_instance *instance, gl_kind kind, size_t count, const unsigned *refs,
                       const void *values);
/* A value as a whole number of a type with this range; a model or a host may hold any double. */
int64_t gl_whole(double value, int64_t low, int64_t high);
/* Only after the check; returns GL_WARNING where the value lies outside its range. */
gl_status gl_set(gl_instance *instance, unsigned reference, double value);

/* Model exchange. What the integrator tries may be refused with GL_DISCARD. */
gl_status gl_enter_events(gl_instance *instance);
gl_status gl_enter_continuous_time(gl_instance *instance);
/* Does what an event changes; returns whether the continuous states have changed. */
gl_status gl_update_discrete(gl_instance *instance, int *states_changed);
/* Tells whether there is something to be done in event mode. */
gl_status gl_complete_step(gl_instance *instance, int *event);
gl_status gl_set_time(gl_instance *instance, double time);
gl_status gl_set_states(gl_instance *instance, const double *values, size_t count);
gl_status gl_get_states(gl_instance *instance, double *values, size_t count);
gl_status gl_get_nominals(gl_instance *instance, double *values, size_t count);
gl_status gl_get_rates(gl_instance *instance, double *values, size_t count);
gl_status gl_get_indicators(gl_instance *instance, double *values, size_t count);
/* Derivatives of computed Reals along a direction of states and inputs. */
gl_status gl_differentiate(gl_instance *instance, const unsigned *unknowns, size_t n_unknowns,
                           const unsigned *knowns, size_t n_knowns, const double *seed,
                           double *derivatives);
/* Derivatives by states and inputs of the sum of computed Reals, each times its seed. */
gl_status gl_differentiate_back(gl_instance *instance, const unsigned *unknowns, size_t n_unknowns,
                                const unsigned *knowns, size_t n_knowns, const double *seed,
                                double *derivatives);

/* States of the host: `place` points at null or at a state that is written over. */
gl_status gl_save(gl_instance *instance, void **place);
gl_status gl_restore(gl_instance *instance, const void *state);
gl_status gl_forget(gl_instance *instance, void **place);
gl_status gl_state_size(gl_instance *instance, const void *state, size_t *size); /* as bytes */
gl_status gl_serialise(gl_instance *instance, const void *state, unsigned char *bytes, size_t size);
gl_status gl_deserialise(gl_instance *instance, const unsigned char *bytes, size_t size,
                         void **place);

#endif
