/* The model as its file describes it. A file that is damaged, or of another library, is refused.

   little-endian as all platforms of these FMUs:
   head:    mark, kind of the library, GUID, counts, checksum of head and body
   doubles: data; start, low, high and nominal value of each variable; unit of each state
   int32:   rows of the variables, texts of all literals, members of all arrays, inputs, outputs,
            states, event indicators, refusals, ranges
   text:    all words, each with a zero behind; an int32 stands for the word that begins there */
#include "internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MARK_SIZE = 8, KIND_SIZE = 40, GUID_AT = MARK_SIZE + KIND_SIZE, COUNTS_AT = GUID_AT + 40 };
/* What the head counts. */
enum { DATA, WORK, TEXT, MEMBERS, REFUSALS, LITERALS, SIZES, N_SIZES = 13,
       COUNTS = SIZES + N_SIZES }; /* gl_sizes */
enum { CHECKSUM_AT = COUNTS_AT + 4 * COUNTS, HEAD_SIZE = CHECKSUM_AT + 4 };
enum { NUMBERS_OF_VARIABLE = 4, ROW_OF_VARIABLE = 9, ROW_OF_RANGE = 5 };
enum { MOST = 1 << 27 }; /* of anything */
static const char MARK[MARK_SIZE + 1] = "gearmod2";
static const char KIND[KIND_SIZE] = GL_KIND;
static const int options_of[GL_MOST_PARAMETERS] = GL_OPTIONS; /* by place; negative: any number */

/* What is left of the file, and whether all that was read of it is sound. */
typedef struct {
    const unsigned char *numbers, *integers;
    const char *text;
    int n_text, is_sound;
    gl_sizes n;
} reader;

static double number(reader *file)
{
    double value;
    memcpy(&value, file->numbers, sizeof value);
    file->numbers += sizeof value;
    return value;
}

static int integer(reader *file, int low, int high)
{
    int32_t value;
    memcpy(&value, file->integers, sizeof value);
    file->integers += sizeof value;
    int fits = low <= value && value <= high;
    file->is_sound &= fits;
    return fits ? value : low;
}

/* The text ends with a zero, so every word in it does. */
static const char *word(reader *file)
{
    return file->text + integer(file, 0, file->n_text - 1);
}

static int reference(reader *file)
{
    return integer(file, 0, file->n.variables - 1);
}

/* Memory of a model, part after part. */
static void *take(unsigned char **memory, size_t count, size_t size)
{
    void *place = *memory;
    *memory += count * size;
    return place;
}

/* Whether all bytes are signs that a host can write down, or zeros. */
static int is_text(const unsigned char *bytes, size_t size)
{
    int is = 1;
    for (size_t i = 0; i < size; i++) {
        is &= bytes[i] == 0 || bytes[i] == '\n' || (' ' <= bytes[i] && bytes[i] <= '~');
    }
    return is;
}

static int highest_place(const gl_sizes *n, gl_causality causality)
{
    return (causality == GL_PARAMETER ? n->parameters
            : causality == GL_INPUT   ? n->inputs
                                      : n->outputs) - 1;
}

/* Reads a variable, without its literals. */
static void read_variable(reader *file, gl_variable *variable)
{
    variable->start = number(file);
    variable->low = number(file);
    variable->high = number(file);
    variable->nominal = number(file);
    variable->name = word(file);
    variable->unit = word(file);
    variable->kind = (gl_kind)integer(file, GL_REAL, GL_BOOLEAN);
    variable->causality = (gl_causality)integer(file, GL_PARAMETER, GL_OUTPUT);
    variable->place = integer(file, -1, highest_place(&file->n, variable->causality));
    variable->option = integer(file, -1, file->n.variables - 1);
    variable->needs = integer(file, GL_NOTHING, GL_ALL);
    int is_set = variable->causality != GL_OUTPUT;
    file->is_sound &= variable->low <= variable->high && isfinite(variable->nominal) &&
                      variable->nominal > 0.0 && isfinite(variable->start) &&
                      (!is_set || (variable->low <= variable->start &&
                                   variable->start <= variable->high)) &&
                      (variable->place < 0) == (variable->option >= 0);
}

/* Whether the places of all variables of a causality are those of the model, each once. */
static int has_places(const gl_model *model, gl_causality causality)
{
    const gl_variable *variables = model->variables;
    unsigned char found[GL_MOST_VARIABLES] = {0};
    int count = 0, places = 0;
    for (int i = 0; i < model->n.variables; i++) {
        int place = variables[i].place;
        if (variables[i].causality == causality && place >= 0) {
            count++;
            places += !found[place];
            found[place] = 1;
        }
    }
    return count == places && count == highest_place(&model->n, causality) + 1;
}

/* Whether a variable names another as whose number it stands, and has the range of that one. */
static int is_option(const gl_variable *variables, const gl_variable *number)
{
    const gl_variable *option = number->option < 0 ? NULL : &variables[number->option];
    return !option || (option->causality == GL_PARAMETER && option->place >= 0 &&
                       option->literals && number->causality == GL_PARAMETER &&
                       number->kind == GL_INTEGER && number->low == 0.0 && number->start == 0.0 &&
                       number->high == option->high);
}

/* Whether a parameter has as many options as the model expects. */
static int has_options(const gl_variable *variable, int n)
{
    if (variable->causality != GL_PARAMETER || variable->place < 0) {
        return 1;
    }
    int expected = options_of[variable->place];
    return expected < 0 ? n > 0 : expected == n;
}

/* What the model needs beyond sound rows: rows that fit each other. */
static int fits_together(const gl_model *model, const int *n_literals)
{
    const gl_variable *variables = model->variables;
    int fits = has_places(model, GL_PARAMETER) && has_places(model, GL_INPUT) &&
               has_places(model, GL_OUTPUT);
    for (int i = 0; i < model->n.variables; i++) {
        const gl_array *array = &model->arrays[i];
        int n = variables[i].literals ? n_literals[i] : 0;
        fits &= is_option(variables, &variables[i]) &&
                (n == 0 || (variables[i].kind == GL_INTEGER && variables[i].low == 1.0 &&
                            variables[i].high == n)) &&
                (variables[i].kind == GL_REAL || variables[i].start == floor(variables[i].start)) &&
                has_options(&variables[i], n);
        for (int k = 0; k < array->count; k++) {
            const gl_variable *member = &variables[array->members[k]];
            fits &= member->kind == variables[i].kind;
        }
    }
    for (int i = 0; i < model->n.inputs; i++) {
        const gl_variable *input = &variables[model->inputs[i]];
        fits &= input->causality == GL_INPUT && input->place == i && input->kind == GL_REAL;
    }
    for (int i = 0; i < model->n.outputs; i++) {
        const gl_variable *output = &variables[model->outputs[i]];
        fits &= output->causality == GL_OUTPUT && output->place == i;
    }
    for (int i = 0; i < model->n.continuous; i++) {
        const gl_continuous_state *state = &model->states[i];
        fits &= variables[state->reference].causality == GL_OUTPUT &&
                variables[state->reference].kind == GL_REAL && isfinite(state->unit) &&
                state->unit != 0.0;
    }
    return fits;
}

/* Makes the model of a file whose length fits its counts; NULL, and why not. */
static gl_model *model_of(reader file, const int counts[COUNTS], char *why)
{
    const gl_sizes n = file.n;
    size_t n_variables = (size_t)n.variables, continuous = (size_t)n.continuous;
    size_t size = sizeof(gl_model) +
                  n_variables * (sizeof(gl_variable) + sizeof(gl_array)) +
                  continuous * sizeof(gl_continuous_state) +
                  (size_t)counts[REFUSALS] * sizeof(gl_refusal) +
                  (size_t)n.ranges * sizeof(gl_range) +
                  (size_t)counts[LITERALS] * sizeof(char *) +
                  (size_t)counts[MEMBERS] * sizeof(unsigned) +
                  (size_t)(n.inputs + n.outputs + n.indicators) * sizeof(int) + (size_t)counts[TEXT];
    size_t data_at = (size + sizeof(double) - 1) / sizeof(double) * sizeof(double);
    /* the data come last: tools that watch memory see whoever reads past them */
    gl_model *model = calloc(1, data_at + (size_t)counts[DATA] * sizeof(double));
    if (!model) {
        snprintf(why, GL_LONGEST_MESSAGE, "There is not enough memory for the model.");
        return NULL;
    }
    unsigned char *memory = (unsigned char *)(model + 1);
    gl_variable *variables = take(&memory, n_variables, sizeof *variables);
    gl_array *arrays = take(&memory, n_variables, sizeof *arrays);
    gl_continuous_state *states = take(&memory, continuous, sizeof *states);
    gl_refusal *refusals = take(&memory, (size_t)counts[REFUSALS], sizeof *refusals);
    gl_range *ranges = take(&memory, (size_t)n.ranges, sizeof *ranges);
    const char **literals = take(&memory, (size_t)counts[LITERALS], sizeof *literals);
    unsigned *members = take(&memory, (size_t)counts[MEMBERS], sizeof *members);
    int *inputs = take(&memory, (size_t)n.inputs, sizeof *inputs);
    int *outputs = take(&memory, (size_t)n.outputs, sizeof *outputs);
    int *indicators = take(&memory, (size_t)n.indicators, sizeof *indicators);
    char *text = take(&memory, (size_t)counts[TEXT], 1);
    memory = (unsigned char *)model + data_at;
    double *data = take(&memory, (size_t)counts[DATA], sizeof *data);
    memcpy(text, file.text, (size_t)counts[TEXT]);
    file.text = text;
    file.n_text = counts[TEXT];
    file.is_sound = counts[TEXT] > 0 && text[counts[TEXT] - 1] == '\0' &&
                    is_text((const unsigned char *)text, (size_t)counts[TEXT]);
    memcpy(data, file.numbers, (size_t)counts[DATA] * sizeof *data);
    file.numbers += (size_t)counts[DATA] * sizeof *data;
    int first = 0, first_literal = 0, n_literals[GL_MOST_VARIABLES];
    for (int i = 0; i < n.variables; i++) {
        read_variable(&file, &variables[i]);
        arrays[i].count = integer(&file, 0, counts[MEMBERS] - first);
        arrays[i].members = members + first;
        first += arrays[i].count;
        n_literals[i] = integer(&file, 0, counts[LITERALS] - first_literal);
        variables[i].literals = n_literals[i] ? literals + first_literal : NULL;
        first_literal += n_literals[i];
    }
    for (int i = 0; i < counts[LITERALS]; i++) {
        literals[i] = word(&file);
    }
    for (int i = 0; i < counts[MEMBERS]; i++) {
        members[i] = (unsigned)reference(&file);
    }
    for (int i = 0; i < n.inputs; i++) {
        inputs[i] = reference(&file);
    }
    for (int i = 0; i < n.outputs; i++) {
        outputs[i] = reference(&file);
    }
    for (int i = 0; i < n.continuous; i++) {
        states[i].reference = reference(&file);
        states[i].rate = reference(&file);
        states[i].place = integer(&file, 0, n.state - 1);
        states[i].unit = number(&file);
    }
    for (int i = 0; i < n.indicators; i++) {
        indicators[i] = reference(&file);
    }
    for (int i = 0; i < counts[REFUSALS]; i++) {
        refusals[i].status = integer(&file, INT32_MIN, INT32_MAX);
        refusals[i].text = word(&file);
    }
    for (int i = 0; i < n.ranges; i++) {
        ranges[i].output = word(&file);
        ranges[i].what = word(&file);
        ranges[i].unit = word(&file);
        ranges[i].beyond = word(&file);
        ranges[i].reference = reference(&file);
    }
    model->n = n;
    model->work = counts[WORK];
    model->n_data = counts[DATA];
    model->n_refusals = counts[REFUSALS];
    model->variables = variables;
    model->arrays = arrays;
    model->inputs = inputs;
    model->outputs = outputs;
    model->states = states;
    model->indicators = indicators;
    model->refusals = refusals;
    model->ranges = ranges;
    model->data = data;
    double lengths[2 + N_SIZES] = {counts[DATA], counts[WORK]};
    for (int i = 0; i < N_SIZES; i++) {
        lengths[2 + i] = counts[SIZES + i];
    }
    int is_sound = file.is_sound && fits_together(model, n_literals);
#if GL_DATA < 0
    double options[GL_MOST_PARAMETERS] = {0.0}, none[1] = {0.0};
    for (int i = 0; is_sound && i < n.variables; i++) {
        if (variables[i].causality == GL_PARAMETER && variables[i].place >= 0) {
            options[variables[i].place] = n_literals[i];
        }
    }
    is_sound = is_sound &&
               !gearlube_entry(GL_CHECK, 0.0, data, lengths, options, none, none, none);
#else
    uint32_t sum = gl_checksum(0, (const unsigned char *)data, (size_t)counts[DATA] * sizeof *data);
    is_sound = is_sound && lengths[0] == GL_DATA && lengths[1] == GL_WORK &&
               (GL_DATA_SUM == 0u || sum == GL_DATA_SUM);
#endif
    if (!is_sound) {
        snprintf(why, GL_LONGEST_MESSAGE,
                 "The model of this FMU is damaged: numbers in its file contradict each other. "
                 "Unpack the FMU once more.");
        free(model);
        return NULL;
    }
    return model;
}

/* How many doubles come before the rows. */
static size_t numbers_of(const int counts[COUNTS], const gl_sizes *n)
{
    return (size_t)counts[DATA] + NUMBERS_OF_VARIABLE * (size_t)n->variables +
           (size_t)n->continuous;
}

/* Length of the file with these counts. */
static size_t length_of(const int counts[COUNTS], const gl_sizes *n)
{
    size_t integers = ROW_OF_VARIABLE * (size_t)n->variables + (size_t)counts[LITERALS] +
                      (size_t)counts[MEMBERS] + (size_t)n->inputs + (size_t)n->outputs +
                      3 * (size_t)n->continuous + (size_t)n->indicators +
                      2 * (size_t)counts[REFUSALS] + ROW_OF_RANGE * (size_t)n->ranges;
    return HEAD_SIZE + 8 * numbers_of(counts, n) + 4 * integers + (size_t)counts[TEXT];
}

/* Whether sizes, none of which is negative, are those of a model of this library. */
static int are_ours(const gl_sizes *n, int work)
{
#if GL_ANY_SIZES
    return 0 < n->variables && n->variables <= GL_MOST_VARIABLES &&
           n->parameters <= GL_MOST_PARAMETERS && n->inputs <= GL_MOST_INPUTS &&
           n->outputs <= GL_MOST_OUTPUTS && n->state <= GL_MOST_STATE &&
           n->control_at <= n->state && n->ranges <= GL_MOST_RANGES &&
           n->continuous <= n->state && n->indicators <= n->variables &&
           n->inputs_at <= n->state - n->inputs && n->exceeded < n->variables &&
           n->limits_at <= work - 2 * n->inputs && n->ranges_at <= work - 2 * n->ranges;
#else
    static const gl_sizes ours = GL_SIZES;
    (void)work;
    return memcmp(n, &ours, sizeof ours) == 0;
#endif
}

static gl_model *checked(const unsigned char *bytes, size_t size, const char *guid,
                         const char *name_of_guid, char *why)
{
    int counts[COUNTS], fits = size >= HEAD_SIZE;
    gl_sizes n;
    char own[GL_GUID_SIZE];
    uint32_t sum;
    if (!fits || memcmp(bytes, MARK, MARK_SIZE)) {
        snprintf(why, GL_LONGEST_MESSAGE,
                 "The file model.bin in the resources of this FMU is none of gearlube.");
        return NULL;
    }
    if (memcmp(bytes + MARK_SIZE, KIND, KIND_SIZE)) {
        snprintf(why, GL_LONGEST_MESSAGE,
                 "The model in the resources of this FMU belongs to another library than this one, "
                 "%s. Unpack the FMU once more, and give its own resources.",
                 GL_MODEL_NAME);
        return NULL;
    }
    memcpy(own, bytes + GUID_AT, GL_GUID_SIZE);
    for (int i = 0; i < COUNTS; i++) {
        int32_t count;
        memcpy(&count, bytes + COUNTS_AT + 4 * i, sizeof count);
        counts[i] = count;
        fits &= 0 <= count && count <= MOST;
    }
    memcpy(&n, counts + SIZES, sizeof n);
    memcpy(&sum, bytes + CHECKSUM_AT, sizeof sum);
    if (!fits || !are_ours(&n, counts[WORK]) || own[GL_GUID_SIZE - 1] || !is_text(bytes + GUID_AT, GL_GUID_SIZE) || length_of(counts, &n) != size ||
        gl_checksum(gl_checksum(0, bytes, CHECKSUM_AT), bytes + HEAD_SIZE, size - HEAD_SIZE) != sum) {
        snprintf(why, GL_LONGEST_MESSAGE,
                 "The model of this FMU is damaged: length or checksum of its file do not agree. "
                 "Unpack the FMU once more.");
        return NULL;
    }
    if (!guid || strcmp(guid, own)) {
        snprintf(why, GL_LONGEST_MESSAGE,
                 "The %s must be %s, that of the model description.", name_of_guid, own);
        return NULL;
    }
    reader file = {.numbers = bytes + HEAD_SIZE, .n = n,
                   .integers = bytes + HEAD_SIZE + 8 * numbers_of(counts, &n),
                   .text = (const char *)bytes + size - counts[TEXT]};
    gl_model *model = model_of(file, counts, why);
    if (model) {
        memcpy(model->guid, own, GL_GUID_SIZE);
    }
    return model;
}

gl_model *gl_load(const char *resources, const char *guid, const char *name_of_guid,
                  char why[GL_LONGEST_MESSAGE])
{
    gl_floats host;
    size_t size = 0;
    gl_take_floats(&host);
    unsigned char *bytes = gl_read_model(resources, &size, why);
    gl_model *model = bytes ? checked(bytes, size, guid, name_of_guid, why) : NULL;
    free(bytes);
    gl_give_floats(&host);
    return model;
}
