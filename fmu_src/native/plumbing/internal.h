/* Shared by the files of an instance, not seen by the FMI functions. */
#ifndef GEARLUBE_INTERNAL_H
#define GEARLUBE_INTERNAL_H

#include "instance.h"

enum { GL_LONGEST_LIMITS = 512 };

/* Writes the range of a variable as words: "within 0 to 1 m", or the names of an option. */
void gl_limits_text(const gl_variable *variable, char *text, size_t size);

/* The content of the model's file, to be freed; NULL, and why not. */
unsigned char *gl_read_model(const char *resources, size_t *size, char why[GL_LONGEST_MESSAGE]);

/* Sets floating point as the model needs it, and as the host had it. */
void gl_take_floats(gl_floats *host);
void gl_give_floats(const gl_floats *host);

/* Reports why one value is refused; returns 0 if none is. */
int gl_say_refused(gl_instance *instance, gl_status status, const char *before);
void gl_find_refused(gl_instance *instance);

/* Parameters of the model, options by number instead of their enumeration. */
void gl_gather_parameters(const gl_model *model, const double *values, double *parameters);
void gl_gather_inputs(const gl_model *model, const double *values, double *inputs);

int gl_all_finite(const double *values, int count);

/* Size of a state of the model. */
size_t gl_state_bytes(const gl_model *model);

/* CRC-32, begun with `seed`. */
uint32_t gl_checksum(uint32_t seed, const unsigned char *bytes, size_t size);

/* Starts the model unless its outputs belong to the present values. */
gl_status gl_start(gl_instance *instance);

/* Reports why an input beyond the limits of the model is refused; returns 0 if none is. */
int gl_say_input_beyond(gl_instance *instance, gl_status status, const char *before);

/* Takes over what the model has computed, as bits. */
void gl_take_outputs(gl_instance *instance, int computed);

/* Computes what is needed of the present state, as bits. */
gl_status gl_refresh(gl_instance *instance, int needed);

/* The same, of the start before the end of initialisation. */
gl_status gl_compute(gl_instance *instance, int needed);

/* Refuses the call unless the instance is in this phase, or in one of both. */
gl_status gl_expect(gl_instance *instance, gl_phase phase);
gl_status gl_expect_either(gl_instance *instance, gl_phase one, gl_phase other);

/* Why an operation was refused, in words. */
const char *gl_refusal_text(const gl_model *model, int64_t status);

/* In model exchange: puts the present inputs into the state, unless they are refused. */
gl_status gl_take_inputs(gl_instance *instance);

/* Refuses a value of a continuous state that is not finite in the model's unit. */
gl_status gl_check_state(gl_instance *instance, int number, double value);
/* Sets one that `gl_check_state` has seen. */
void gl_put_state(gl_instance *instance, int number, double value);

/* Number of a continuous state by the reference of its variable; -1: none such. */
int gl_state_number(const gl_model *model, unsigned reference);

/* Counts and says what is outside its range; all outputs must be those of now. */
void gl_watch_ranges(gl_instance *instance);
/* Whether it is time to do so. */
int gl_is_unwatched(const gl_instance *instance);

#endif
