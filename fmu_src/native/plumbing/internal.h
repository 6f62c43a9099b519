/* Shared by the files of an instance, not seen by the FMI functions. */
#ifndef GEARLUBE_INTERNAL_H
#define GEARLUBE_INTERNAL_H

#include "instance.h"

enum { GL_LONGEST_LIMITS = 512 };

/* Writes the range of a variable as words: "within 0 to 1 m", or the names of an option. */
void gl_limits_text(const gl_variable *variable, char *text, size_t size);

/* Says of one refused value why; returns 0 if none is refused. */
int gl_say_refused(gl_instance *instance, gl_status status, const char *before);
void gl_find_refused(gl_instance *instance);

/* Parameters of the model, options by number in the place of their enumeration. */
void gl_gather_parameters(const double *values, double *parameters);
void gl_gather_inputs(const double *values, double *inputs);

int gl_all_finite(const double *values, int count);

/* Starts the model unless its outputs belong to the present values. */
gl_status gl_start(gl_instance *instance);

/* Computes the outputs of the present state: 1 those of the motion, 2 all. */
gl_status gl_refresh(gl_instance *instance, int needed);

#endif
