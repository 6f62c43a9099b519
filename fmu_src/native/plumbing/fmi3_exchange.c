/* FMI 3.0 for model exchange, what FMI 2 has not alike. */
#include "fmi3Functions.h"

#include "instance.h"

/* In the order of the standard: OK, warning, discard, error. */
static fmi3Status answer(gl_status status)
{
    return (fmi3Status)status;
}

static fmi3Status no_pointer(gl_instance *instance)
{
    return answer(GL_CALL(instance, gl_refuse(instance, "A pointer of the call is null.")));
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *needed, fmi3Boolean *terminate,
                                    fmi3Boolean *nominals_changed, fmi3Boolean *values_changed,
                                    fmi3Boolean *next_defined, fmi3Float64 *next)
{
    int changed = 0;
    if (!gl_is_instance(c)) {
        return fmi3Error;
    }
    if (!needed || !terminate || !nominals_changed || !values_changed || !next_defined || !next) {
        return no_pointer(c);
    }
    gl_status status = GL_CALL(c, gl_update_discrete(c, &changed));
    if (status == GL_OK) {
        *needed = *terminate = *nominals_changed = *next_defined = false;
        *values_changed = changed != 0;
        *next = 0.0;
    }
    return answer(status);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64 x[], size_t n)
{
    return answer(GL_CALL(c, gl_get_rates(c, x, n)));
}

/* How many event indicators there are, or how many continuous states. */
static fmi3Status tell_number(gl_instance *instance, size_t *place, int of_indicators)
{
    if (!gl_is_instance(instance)) {
        return fmi3Error;
    }
    if (!place) {
        return no_pointer(instance);
    }
    const gl_sizes *sizes = &instance->model->n;
    *place = (size_t)(of_indicators ? sizes->indicators : sizes->continuous);
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t *n)
{
    return tell_number(c, n, 1);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t *n)
{
    return tell_number(c, n, 0);
}

/* Writes the elements of all arrays one after the other; returns 0 if they are not `count`. */
static int elements(const gl_model *model, const fmi3ValueReference refs[], size_t n, size_t count, unsigned *found)
{
    size_t k = 0;
    for (size_t i = 0; i < n; i++) {
        const gl_array *array = refs[i] < (unsigned)model->n.variables ? &model->arrays[refs[i]] : NULL;
        if (!array || array->count == 0) {
            return 0;
        }
        for (int j = 0; j < array->count; j++) {
            if (k == (size_t)model->n.variables) {
                return 0;
            }
            found[k++] = array->members[j];
        }
    }
    return k == count;
}

typedef gl_status (*gl_derivative)(gl_instance *, const unsigned *, size_t, const unsigned *, size_t,
                                   const double *, double *);

/* Derivatives of all elements, along a direction or back; so many values go with each list. */
static fmi3Status differentiate(gl_instance *instance, gl_derivative derivative,
                                const fmi3ValueReference unknowns[], size_t n_unknowns, size_t rows,
                                const fmi3ValueReference knowns[], size_t n_knowns, size_t columns,
                                const fmi3Float64 seed[], fmi3Float64 sensitivity[])
{
    unsigned of_unknowns[GL_MOST_VARIABLES], of_knowns[GL_MOST_VARIABLES];
    if (!gl_is_instance(instance)) {
        return fmi3Error;
    }
    if ((n_unknowns && !unknowns) || (n_knowns && !knowns)) {
        return no_pointer(instance);
    }
    if (!elements(instance->model, unknowns, n_unknowns, rows, of_unknowns) ||
        !elements(instance->model, knowns, n_knowns, columns, of_knowns)) {
        return answer(GL_CALL(instance,
                              gl_refuse(instance, "Value references of variables are expected, each "
                                                  "once, and as many values as they have elements.")));
    }
    return answer(GL_CALL(instance, derivative(instance, of_unknowns, rows, of_knowns, columns, seed,
                                               sensitivity)));
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const fmi3ValueReference unknowns[],
                                        size_t n_unknowns, const fmi3ValueReference knowns[],
                                        size_t n_knowns, const fmi3Float64 seed[], size_t n_seed,
                                        fmi3Float64 sensitivity[], size_t n_sensitivity)
{
    return differentiate(c, gl_differentiate, unknowns, n_unknowns, n_sensitivity, knowns, n_knowns,
                         n_seed, seed, sensitivity);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance c, const fmi3ValueReference unknowns[],
                                    size_t n_unknowns, const fmi3ValueReference knowns[],
                                    size_t n_knowns, const fmi3Float64 seed[], size_t n_seed,
                                    fmi3Float64 sensitivity[], size_t n_sensitivity)
{
    return differentiate(c, gl_differentiate_back, unknowns, n_unknowns, n_seed, knowns, n_knowns,
                         n_sensitivity, seed, sensitivity);
}
