/* Floating point as the model needs it during a call, whatever the host has set: no traps, rounding
   to nearest, denormal numbers. Flags of exceptions are the host's again after the call. */
#include "instance.h"
#include "internal.h"

#if defined(__x86_64__)
/* All exceptions masked; mathematics of Windows computes in the older unit, in its full precision. */
static const uint32_t SSE_DEFAULT = 0x1f80;
static const uint16_t X87_DEFAULT = 0x037f;
enum { X87_FLAGS = 0x3f, X87_PENDING = 0x80 };

void gl_take_floats(gl_floats *host)
{
    __asm__ volatile("stmxcsr %0\n\tfnstcw %1\n\tfnstsw %2"
                     : "=m"(host->sse), "=m"(host->x87), "=m"(host->x87_status));
    if (host->x87_status & X87_PENDING) { /* a trap that the host has not met yet */
        __asm__ volatile("fnclex");
    }
    __asm__ volatile("ldmxcsr %0\n\tfldcw %1" : : "m"(SSE_DEFAULT), "m"(X87_DEFAULT));
}

void gl_give_floats(const gl_floats *host)
{
    uint16_t status;
    uint32_t environment[7]; /* control, status, and what stays */
    __asm__ volatile("fnstsw %0" : "=m"(status));
    if ((status ^ host->x87_status) & X87_FLAGS) { /* rare: this takes 70 ns */
        __asm__ volatile("fnstenv %0" : "=m"(environment));
        environment[1] = host->x87_status;
        __asm__ volatile("fldenv %0" : : "m"(environment));
    }
    __asm__ volatile("fldcw %0\n\tldmxcsr %1" : : "m"(host->x87), "m"(host->sse));
}
#elif defined(__aarch64__)
void gl_take_floats(gl_floats *host)
{
    __asm__ volatile("mrs %0, fpcr\n\tmrs %1, fpsr\n\tmsr fpcr, xzr"
                     : "=&r"(host->control), "=r"(host->flags));
}

void gl_give_floats(const gl_floats *host)
{
    __asm__ volatile("msr fpcr, %0\n\tmsr fpsr, %1" : : "r"(host->control), "r"(host->flags));
}
#else
#error "How are traps and rounding of this processor set?"
#endif

int gl_enter(gl_instance *instance)
{
    if (!gl_is_instance(instance)) {
        return 0;
    }
    gl_take_floats(&instance->host_floats);
    return 1;
}

gl_status gl_leave(gl_instance *instance, gl_status status)
{
    gl_give_floats(&instance->host_floats);
    return status;
}
