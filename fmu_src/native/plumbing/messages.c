/* Messages to the host, in categories that it can switch on and off. */
#include "instance.h"
#include "internal.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *const gl_log_names[GL_LOGS] = {"logEvents", "logStatusWarning", "logStatusDiscard",
                                           "logStatusError"};

static gl_log log_of(gl_status status)
{
    return (gl_log)status; /* in the same order */
}

static void pass_on(gl_instance *instance, gl_status status, const char *text, va_list arguments)
{
    if (!(instance->logs & 1u << log_of(status)) || !instance->listener) {
        return;
    }
    char whole[GL_LONGEST_MESSAGE];
    vsnprintf(whole, sizeof whole, text, arguments);
    gl_give_floats(&instance->host_floats); /* the host computes in its own way */
    instance->listener(instance, status, gl_log_names[log_of(status)], whole);
    gl_take_floats(&instance->host_floats);
}

void gl_say(gl_instance *instance, gl_status status, const char *text, ...)
{
    va_list arguments;
    va_start(arguments, text);
    pass_on(instance, status, text, arguments);
    va_end(arguments);
}

gl_status gl_refuse(gl_instance *instance, const char *text, ...)
{
    va_list arguments;
    va_start(arguments, text);
    pass_on(instance, GL_ERROR, text, arguments);
    va_end(arguments);
    return GL_ERROR;
}

void gl_say_no_instance(const char *name, const char *text)
{
    fprintf(stderr, "%s: %s\n", name && *name ? name : GL_MODEL_NAME, text);
}

gl_status gl_choose_logs(gl_instance *instance, int on, size_t count, const char *const names[])
{
    unsigned chosen = count ? 0 : GL_ALL_LOGS;
    if (count && !names) {
        return gl_refuse(instance, "The names of the log categories are missing.");
    }
    for (size_t i = 0; i < count; i++) {
        unsigned found = names[i] && !strcmp(names[i], "logAll") ? GL_ALL_LOGS : 0;
        if (names[i] && !strcmp(names[i], "logStatusFatal")) {
            found = 1u << GL_LOG_ERROR; /* nothing is fatal to this FMU */
        }
        for (int k = 0; k < GL_LOGS && names[i]; k++) {
            found |= strcmp(names[i], gl_log_names[k]) ? 0 : 1u << k;
        }
        if (!found) {
            return gl_refuse(instance, "%s is no log category of this FMU.",
                             names[i] ? names[i] : "A null pointer");
        }
        chosen |= found;
    }
    instance->logs = on ? chosen : instance->logs & ~chosen;
    return GL_OK;
}
