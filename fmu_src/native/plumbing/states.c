/* Saved states: in memory, and as bytes that another process can continue from. */
#include "instance.h"
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Layout of the bytes, little-endian as all platforms of these FMUs: mark, GUID, phase, checksum of
   what follows, time, values, state. */
enum {
    MARK_SIZE = 8,
    OWNER_SIZE = GL_GUID_SIZE,
    HEADER_SIZE = MARK_SIZE + OWNER_SIZE + 4 + 4,
    OF_EXCHANGE = 256 /* added to the phase in model exchange */
};
static const char MARK[MARK_SIZE + 1] = "gearlub2";

static size_t values_bytes(const gl_model *model)
{
    return sizeof(double) * (size_t)model->n.variables;
}

/* Of time, values and state. */
static size_t numbers_bytes(const gl_model *model)
{
    return sizeof(double) + values_bytes(model) + gl_state_bytes(model);
}

static const char FREED[] = "The state is none of this FMU, or has been freed. Save one again.";

/* States that hosts hold. A host gets a number that is never given again, not an address: a freed
   state is known as such without a look at its memory. Any instance of this library may use a
   state of its own model. Instances of several threads go through the rows one at a time, for some nanoseconds. */
typedef struct held {
    uintptr_t name;
    char owner[OWNER_SIZE]; /* GUID of the model */
    gl_snapshot snapshot;
    struct held *next;
} held;
enum { ROWS = 1024 };
static held *rows[ROWS];
static uintptr_t names_given;

#ifdef _MSC_VER
#include <intrin.h>
static volatile long busy;
#define LOCK() while (_InterlockedExchange(&busy, 1)) {}
#define UNLOCK() _InterlockedExchange(&busy, 0)
#else
static char busy;
#define LOCK() while (__atomic_test_and_set(&busy, __ATOMIC_ACQUIRE)) {}
#define UNLOCK() __atomic_clear(&busy, __ATOMIC_RELEASE)
#endif

/* Where the state of this name hangs, or where its row ends; only while the rows are locked. */
static held **link_of(uintptr_t name)
{
    held **link = &rows[name % ROWS];
    while (*link && (*link)->name != name) {
        link = &(*link)->next;
    }
    return link;
}

/* Gives a state a name; far from those of other libraries, which begin at their own rows. */
static void *hold(held *state)
{
    LOCK();
    state->name = (uintptr_t)rows + (uintptr_t)0x9e3779b97f4a7c15u * ++names_given;
    held **link = link_of(state->name);
    state->next = NULL;
    *link = state;
    UNLOCK();
    return (void *)state->name;
}

/* Eight bytes at a time: place k of the table is what a byte does k bytes later. */
uint32_t gl_checksum(uint32_t seed, const unsigned char *bytes, size_t size)
{
    uint32_t table[8][256], crc = ~seed;
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t one = i;
        for (int k = 0; k < 8; k++) {
            one = one >> 1 ^ (0xedb88320u & (0u - (one & 1u)));
        }
        table[0][i] = one;
    }
    for (int k = 1; k < 8; k++) {
        for (int i = 0; i < 256; i++) {
            table[k][i] = table[k - 1][i] >> 8 ^ table[0][table[k - 1][i] & 255u];
        }
    }
    for (; size >= 8; size -= 8, bytes += 8) {
        uint32_t low, high;
        memcpy(&low, bytes, 4);
        memcpy(&high, bytes + 4, 4);
        low ^= crc;
        crc = table[7][low & 255u] ^ table[6][low >> 8 & 255u] ^ table[5][low >> 16 & 255u] ^
              table[4][low >> 24] ^ table[3][high & 255u] ^ table[2][high >> 8 & 255u] ^
              table[1][high >> 16 & 255u] ^ table[0][high >> 24];
    }
    for (; size; size--, bytes++) {
        crc = crc >> 8 ^ table[0][(crc ^ *bytes) & 255u];
    }
    return ~crc;
}

static gl_status check_pointers(gl_instance *instance, const void *one, const void *other)
{
    return one && other ? GL_OK : gl_refuse(instance, "A pointer of the call is null.");
}

static gl_status refuse_owner(gl_instance *instance)
{
    return gl_refuse(instance,
                     "The FMU state must come from the FMU with GUID %s. Restore it in the FMU that "
                     "wrote it.",
                     instance->model->guid);
}

/* The snapshot of a state; NULL, and a message, if the state is none. */
static gl_snapshot *found(gl_instance *instance, const void *state)
{
    if (!state) {
        gl_refuse(instance, "The state is missing: a null pointer.");
        return NULL;
    }
    LOCK();
    held *there = *link_of((uintptr_t)state);
    UNLOCK();
    if (!there) {
        gl_refuse(instance, FREED);
        return NULL;
    }
    if (memcmp(there->owner, instance->model->guid, OWNER_SIZE)) {
        refuse_owner(instance);
        return NULL;
    }
    return &there->snapshot;
}

/* Keeps a snapshot where the host has one, or in new memory. */
static gl_status keep(gl_instance *instance, const gl_snapshot *snapshot, void **place)
{
    if (*place) {
        gl_snapshot *old = found(instance, *place);
        if (!old) {
            return GL_ERROR;
        }
        *old = *snapshot;
        return GL_OK;
    }
    held *state = malloc(sizeof *state);
    if (!state) {
        return gl_refuse(instance, "There is not enough memory for a state.");
    }
    state->snapshot = *snapshot;
    memcpy(state->owner, instance->model->guid, OWNER_SIZE);
    *place = hold(state);
    return GL_OK;
}

/* In model exchange outputs follow from states and inputs: a state holds no trace of what the host
   has read. */
static gl_status keep_of_exchange(gl_instance *instance, void **place)
{
    gl_snapshot snapshot = instance->now;
    for (int i = 0; i < instance->model->n.outputs; i++) {
        snapshot.values[instance->model->outputs[i]] = 0.0;
    }
    for (int i = 0; i < instance->model->n.inputs; i++) {
        snapshot.state[instance->model->n.inputs_at + i] = 0.0;
    }
    return keep(instance, &snapshot, place);
}

gl_status gl_save(gl_instance *instance, void **place)
{
    int started = instance->now.phase >= GL_STEPPING;
    gl_status status = check_pointers(instance, place, instance);
    if (status == GL_OK && started && instance->now.exchange) {
        return keep_of_exchange(instance, place);
    }
    if (status == GL_OK && started) {
        status = gl_refresh(instance, GL_ALL); /* a state of co-simulation holds all outputs */
    }
    return status == GL_OK ? keep(instance, &instance->now, place) : status;
}

gl_status gl_forget(gl_instance *instance, void **place)
{
    if (!place || !*place) {
        return GL_OK;
    }
    LOCK();
    held **link = link_of((uintptr_t)*place), *state = *link;
    if (state) {
        *link = state->next;
    }
    UNLOCK();
    if (!state) {
        return gl_refuse(instance, FREED);
    }
    free(state);
    *place = NULL;
    return GL_OK;
}

gl_status gl_state_size(gl_instance *instance, const void *state, size_t *size)
{
    gl_status status = check_pointers(instance, state, size);
    if (status == GL_OK && !found(instance, state)) {
        status = GL_ERROR;
    }
    if (status == GL_OK) {
        *size = HEADER_SIZE + numbers_bytes(instance->model);
    }
    return status;
}

gl_status gl_serialise(gl_instance *instance, const void *state, unsigned char *bytes, size_t size)
{
    gl_status status = check_pointers(instance, state, bytes);
    const gl_snapshot *snapshot = status == GL_OK ? found(instance, state) : NULL;
    if (!snapshot) {
        return GL_ERROR;
    }
    size_t of_values = values_bytes(instance->model), of_numbers = numbers_bytes(instance->model);
    if (size < HEADER_SIZE + of_numbers) {
        return gl_refuse(instance, "A state needs %lu bytes, got room for %lu.",
                         (unsigned long)(HEADER_SIZE + of_numbers), (unsigned long)size);
    }
    unsigned char *numbers = bytes + HEADER_SIZE;
    uint32_t phase = (uint32_t)snapshot->phase + (snapshot->exchange ? OF_EXCHANGE : 0);
    memset(bytes, 0, HEADER_SIZE);
    memcpy(bytes, MARK, MARK_SIZE);
    memcpy(bytes + MARK_SIZE, instance->model->guid, OWNER_SIZE);
    memcpy(bytes + MARK_SIZE + OWNER_SIZE, &phase, 4);
    memcpy(numbers, &snapshot->time, 8);
    memcpy(numbers + 8, snapshot->values, of_values);
    memcpy(numbers + 8 + of_values, snapshot->state, gl_state_bytes(instance->model));
    uint32_t sum = gl_checksum(phase, numbers, of_numbers);
    memcpy(bytes + HEADER_SIZE - 4, &sum, 4);
    return GL_OK;
}

static int is_sound(const gl_model *model, const gl_snapshot *snapshot)
{
    int started = snapshot->phase >= GL_STEPPING;
    int of_other_kind = snapshot->exchange ? snapshot->phase == GL_STEPPING
                                           : snapshot->phase == GL_EVENTS ||
                                                 snapshot->phase == GL_CONTINUOUS_TIME;
    int sound = isfinite(snapshot->time) && !of_other_kind;
    for (int i = 0; i < model->n.variables; i++) {
        const gl_variable *variable = &model->variables[i];
        double value = snapshot->values[i];
        int may_be_refused = variable->causality == GL_INPUT ||
                             (variable->causality == GL_PARAMETER && !started);
        sound = sound && (may_be_refused || (variable->low <= value && value <= variable->high)) &&
                (may_be_refused || isfinite(value)) &&
                (variable->kind == GL_REAL || value == floor(value));
    }
    if (started) {
        sound = sound && gl_all_finite(snapshot->state, model->n.state);
        for (int i = model->n.control_at; i < model->n.state; i++) {
            sound = sound && snapshot->state[i] > 0.0;
        }
    }
    return sound;
}

static gl_status from_bytes(gl_instance *instance, const unsigned char *bytes, size_t size,
                            gl_snapshot *snapshot)
{
    uint32_t phase, sum;
    if (size < HEADER_SIZE || memcmp(bytes, MARK, MARK_SIZE)) {
        return gl_refuse(instance, "The FMU state was not written by a native gearlube FMU.");
    }
    if (memcmp(bytes + MARK_SIZE, instance->model->guid, OWNER_SIZE)) {
        return refuse_owner(instance);
    }
    memcpy(&phase, bytes + MARK_SIZE + OWNER_SIZE, 4);
    memcpy(&sum, bytes + HEADER_SIZE - 4, 4);
    const unsigned char *numbers = bytes + HEADER_SIZE;
    size_t of_values = values_bytes(instance->model), of_numbers = numbers_bytes(instance->model);
    snapshot->exchange = (phase & OF_EXCHANGE) != 0;
    snapshot->phase = (gl_phase)(phase & ~(uint32_t)OF_EXCHANGE);
    if (size != HEADER_SIZE + of_numbers || (phase & ~(uint32_t)OF_EXCHANGE) > GL_TERMINATED ||
        gl_checksum(phase, numbers, of_numbers) != sum) {
        return gl_refuse(instance, "The FMU state is damaged: length or checksum do not agree.");
    }
    memcpy(&snapshot->time, numbers, 8);
    memcpy(snapshot->values, numbers + 8, of_values);
    memcpy(snapshot->state, numbers + 8 + of_values, gl_state_bytes(instance->model));
    if (!is_sound(instance->model, snapshot)) {
        return gl_refuse(instance, "The FMU state holds numbers that no run of it leaves.");
    }
    return GL_OK;
}

gl_status gl_deserialise(gl_instance *instance, const unsigned char *bytes, size_t size,
                         void **place)
{
    gl_snapshot read;
    gl_status status = check_pointers(instance, bytes, place);
    if (status == GL_OK) {
        status = from_bytes(instance, bytes, size, &read);
    }
    return status == GL_OK ? keep(instance, &read, place) : status;
}

gl_status gl_restore(gl_instance *instance, const void *state)
{
    const gl_snapshot *snapshot = found(instance, state);
    if (!snapshot) {
        return GL_ERROR;
    }
    if (snapshot->exchange != instance->now.exchange) {
        return gl_refuse(instance, "The FMU state must be one of %s, as this instance is.",
                         instance->now.exchange ? "model exchange" : "co-simulation");
    }
    if (snapshot->phase >= GL_STEPPING) {
        double parameters[GL_MOST_PARAMETERS], inputs[GL_MOST_INPUTS], of_model[GL_MOST_STATE];
        gl_gather_parameters(instance->model, snapshot->values, parameters);
        gl_gather_inputs(instance->model, snapshot->values, inputs);
        memcpy(of_model, snapshot->state, gl_state_bytes(instance->model));
        instance->differentiated = 0;
        int64_t status = gearlube_entry(GL_RESUME, 0.0, instance->model->data, parameters, inputs,
                                        of_model, instance->work, instance->outputs);
        if (status != 0) {
            if (instance->now.phase >= GL_STEPPING) { /* back to its own, which are sound */
                gearlube_entry(GL_RESUME, 0.0, instance->model->data, instance->parameters, inputs,
                               of_model, instance->work, instance->outputs);
            }
            return gl_refuse(instance, "The FMU state holds parameters that contradict each other.");
        }
        memcpy(instance->parameters, parameters, sizeof parameters);
    }
    instance->now = *snapshot;
    instance->fresh = snapshot->exchange ? 0 : GL_ALL;
    instance->step_refused = 0;
    instance->watched = snapshot->time;
    instance->stale = snapshot->phase < GL_STEPPING;
    gl_find_refused(instance);
    return GL_OK;
}
