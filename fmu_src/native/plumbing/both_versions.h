/* Functions that FMI 2 and FMI 3 have alike. fmi2.c and fmi3.c include this, each behind its own
   `#define FMI(name)`, which puts the version before a name, and `#define STATE(before, after)`: FMI 2
   writes FMUstate, FMI 3 FMUState. */

static FMI(Status) answer(gl_status status)
{
    return (FMI(Status))status; /* all count OK, warning, discard, error */
}

static FMI(Status) no_pointer(gl_instance *instance)
{
    return answer(GL_CALL(instance, gl_refuse(instance, "A pointer of the call is null.")));
}

FMI(Status) FMI(SetDebugLogging)(void *c, FMI(Boolean) on, size_t n, const char *const names[])
{
    return answer(GL_CALL(c, gl_choose_logs(c, on, n, names)));
}

void FMI(FreeInstance)(void *c)
{
    gl_free(c);
}

FMI(Status) FMI(SetTime)(void *c, double time)
{
    return answer(GL_CALL(c, gl_set_time(c, time)));
}

/* Functions that only hand over to one of an instance. */
#define HAND_OVER(name, function)                                                                 \
    FMI(Status) FMI(name)(void *c)                                                                \
    {                                                                                             \
        return answer(GL_CALL(c, function(c)));                                                   \
    }
#define HAND_OVER_VALUES(name, function, type)                                                    \
    FMI(Status) FMI(name)(void *c, type values[], size_t n)                                       \
    {                                                                                             \
        return answer(GL_CALL(c, function(c, values, n)));                                        \
    }

HAND_OVER(ExitInitializationMode, gl_exit_initialisation)
HAND_OVER(Terminate, gl_terminate)
HAND_OVER(Reset, gl_reset)
HAND_OVER(EnterEventMode, gl_enter_events)
HAND_OVER(EnterContinuousTimeMode, gl_enter_continuous_time)
HAND_OVER_VALUES(SetContinuousStates, gl_set_states, const double)
HAND_OVER_VALUES(GetContinuousStates, gl_get_states, double)
HAND_OVER_VALUES(GetNominalsOfContinuousStates, gl_get_nominals, double)
HAND_OVER_VALUES(GetEventIndicators, gl_get_indicators, double)

FMI(Status) STATE(Get, )(void *c, void **state)
{
    return answer(GL_CALL(c, gl_save(c, state)));
}

FMI(Status) STATE(Set, )(void *c, void *state)
{
    return answer(GL_CALL(c, gl_restore(c, state)));
}

FMI(Status) STATE(Free, )(void *c, void **state)
{
    return answer(GL_CALL(c, gl_forget(c, state)));
}

FMI(Status) STATE(Serialized, Size)(void *c, void *state, size_t *size)
{
    return answer(GL_CALL(c, gl_state_size(c, state, size)));
}

FMI(Status) STATE(Serialize, )(void *c, void *state, FMI(Byte) bytes[], size_t size)
{
    return answer(GL_CALL(c, gl_serialise(c, state, (unsigned char *)bytes, size)));
}

FMI(Status) FMI(CompletedIntegratorStep)(void *c, FMI(Boolean) no_way_back,
                                         FMI(Boolean) *enter_event_mode, FMI(Boolean) *terminate)
{
    int due = 0;
    if (!gl_is_instance(c)) {
        return FMI(Error);
    }
    if (!enter_event_mode || !terminate) {
        return no_pointer(c);
    }
    gl_status status = GL_CALL(c, gl_complete_step(c, &due));
    if (status == GL_OK) {
        *enter_event_mode = due != 0;
        *terminate = 0;
    }
    return answer(status);
}
