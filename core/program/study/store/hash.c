/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hashes everything on which results depend. */
#include "hash.h"

#include <string.h>

uint64_t study_hash(uint64_t hash, const void *data, size_t length)
{
    const unsigned char *at = data;
    for (size_t i = 0; i < length; i++)
        hash = (hash ^ at[i]) * UINT64_C(0x100000001b3);
    return hash;
}

uint64_t study_hash_text(uint64_t hash, const char *text)
{
    return text ? study_hash(hash, text, strlen(text) + 1) : study_hash(hash, "\1", 2);
}

static uint64_t hash_number(uint64_t hash, uint64_t number)
{
    return study_hash(hash, &number, sizeof number);
}

/* Hashes the contents of a file. If the file cannot be read, the model reports that. */
static uint64_t hash_file(uint64_t hash, const char *path)
{
    unsigned char block[4096];
    size_t length;
    FILE *stream = fopen(path, "re");
    while (stream && (length = fread(block, 1, sizeof block, stream)) > 0)
        hash = study_hash(hash, block, length);
    if (stream)
        fclose(stream);
    return hash_number(hash, stream != NULL);
}

static uint64_t hash_param(uint64_t hash, const ff_bound *bound)
{
    const ff_value *value = &bound->value;
    double real = value->real + 0.0; /* turns -0 into 0 */
    hash = study_hash_text(hash, bound->row->name);
    hash = hash_number(hash, bound->present);
    if (!bound->present)
        return hash;
    hash = hash_number(hash, (uint64_t)value->given);
    hash = hash_number(hash, (uint64_t)value->integer);
    hash = study_hash(hash, &real, sizeof real);
    hash = hash_number(hash, value->count);
    if (value->count)
        hash = study_hash(hash, value->reals, value->count * sizeof *value->reals);
    if (bound->row->type == FF_FILE && value->text)
        return hash_file(hash, value->text);
    return study_hash_text(hash, value->text);
}

/* Hashes the model and parameters of a stage, and which outputs it computes. */
static uint64_t hash_setup(const ff_stage *stage)
{
    const ff_model *model = stage->loaded->model;
    uint64_t hash = study_hash_text(STUDY_HASH_START, model->id);
    hash = study_hash_text(hash, model->version);
    hash = hash_number(hash, stage->loaded->build);
    if (stage->unread) /* it may lack lines */
        hash = study_hash_text(hash, "unread");
    for (size_t i = 0; i < model->param_count; i++)
        hash = hash_param(hash, &stage->params[i]);
    for (size_t i = 0; i < model->output_count; i++)
        hash = hash_number(study_hash_text(hash, stage->results[i].row->name),
                           stage->results[i].wanted);
    return hash;
}

static uint64_t hash_feedback(uint64_t hash, const ff_feedback *feedback)
{
    hash = hash_number(hash, (uint64_t)feedback->rounds);
    hash = study_hash(hash, &feedback->tolerance, sizeof feedback->tolerance);
    return study_hash(hash, &feedback->relaxation, sizeof feedback->relaxation);
}

/* Returns the position, from 1, in the stage's loop of the stage that feeds the wire, or 0 if that
   stage is outside the loop. */
static size_t place_in_loop(const ff_pipeline *pipeline, const ff_stage *stage, const ff_wire *wire)
{
    for (size_t i = 0; stage->loop && wire->stage >= 0 && i < stage->loop->count; i++)
        if (pipeline->order[stage->loop->first + i] == (size_t)wire->stage)
            return i + 1;
    return 0;
}

/* Hashes the wires of a stage by the outputs that feed them. */
static uint64_t hash_wires(uint64_t hash, const ff_pipeline *pipeline, const ff_stage *stage,
                           const uint64_t *fingerprints)
{
    for (size_t k = 0; k < stage->wire_count; k++) {
        const ff_wire *wire = &stage->wires[k];
        size_t inside = place_in_loop(pipeline, stage, wire);
        hash = study_hash_text(hash, wire->name);
        hash = hash_number(hash, wire->stage < 0 ? 0 : inside ? inside : fingerprints[wire->stage]);
    }
    return hash;
}

/* Sets the same fingerprint for all stages of a loop, since a change in one of them affects all. */
static void mark_loop(const ff_pipeline *pipeline, const ff_loop *loop, uint64_t *fingerprints)
{
    const size_t *members = &pipeline->order[loop->first];
    uint64_t node = hash_feedback(STUDY_HASH_START, &pipeline->feedback);
    for (size_t i = 0; i < loop->count; i++) {
        const ff_stage *stage = &pipeline->stages[members[i]];
        node = hash_number(node, hash_setup(stage));
        node = hash_wires(node, pipeline, stage, fingerprints);
    }
    for (size_t i = 0; i < loop->count; i++)
        fingerprints[members[i]] = hash_number(node, i);
}

uint64_t study_fingerprint(const ff_pipeline *pipeline, uint64_t *fingerprints)
{
    uint64_t whole = STUDY_HASH_START;
    for (size_t i = 0; i < pipeline->count; i++) {
        size_t at = pipeline->order[i];
        const ff_stage *stage = &pipeline->stages[at];
        if (!stage->needed)
            continue;
        if (!stage->loop)
            fingerprints[at] = hash_wires(hash_setup(stage), pipeline, stage, fingerprints);
        else if (i == stage->loop->first)
            mark_loop(pipeline, stage->loop, fingerprints);
    }
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        for (size_t k = 0; stage->needed && k < stage->loaded->model->output_count; k++)
            if (stage->results[k].requested) {
                whole = hash_number(study_hash_text(whole, stage->name), fingerprints[i]);
                whole = study_hash_text(whole, stage->results[k].row->name);
            }
    }
    return whole;
}

/* Returns the wire of an input row, or NULL if the stage has none. */
static const ff_wire *find_wire(const ff_stage *stage, const char *input)
{
    for (size_t i = 0; i < stage->wire_count; i++)
        if (strlen(stage->wires[i].name) == strcspn(input, ".") &&
            !strncmp(stage->wires[i].name, input, strcspn(input, ".")))
            return &stage->wires[i];
    return NULL;
}

/* Hashes the arrays that feed the stage. For an array from its own loop, hashes which stage gives
   it. */
static uint64_t hash_inputs(uint64_t hash, const ff_pipeline *pipeline, const ff_stage *stage,
                            const uint64_t *fingerprints)
{
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const ff_port *row = ff_model_input(stage->loaded->model, i);
        const ff_wire *any = find_wire(stage, row->name), *wire = row->service ? any : NULL;
        const ff_result *given = ff_feeding_result(pipeline, stage, i);
        size_t inside = any ? place_in_loop(pipeline, stage, any) : 0;
        hash = study_hash_text(hash, row->name);
        if (inside) {
            hash = hash_number(hash, inside);
            continue;
        }
        if (wire && wire->stage >= 0)
            hash = hash_number(hash, fingerprints[wire->stage]);
        if (!given || !given->data)
            continue;
        hash = hash_number(hash, given->rank);
        hash = study_hash(hash, given->shape, given->rank * sizeof *given->shape);
        hash = study_hash(hash, given->data, given->count * sizeof *given->data);
    }
    return hash;
}

uint64_t study_hash_evaluation(const ff_pipeline *pipeline, const ff_stage *stage,
                               const uint64_t *fingerprints)
{
    uint64_t hash = study_hash_text(hash_setup(stage), "file format 2");
    if (!stage->loop)
        return hash_inputs(hash, pipeline, stage, fingerprints);
    hash = hash_feedback(hash, &pipeline->feedback);
    for (size_t i = 0; i < stage->loop->count; i++) {
        const ff_stage *member = &pipeline->stages[pipeline->order[stage->loop->first + i]];
        hash = hash_number(hash, hash_setup(member));
        hash = hash_inputs(hash, pipeline, member, fingerprints);
    }
    return hash;
}
