/* SPDX-License-Identifier: MIT */
/* Finds which wire an input is on, which output feeds it, and which outputs are wanted. */
#include "build.h"

#include <assert.h>
#include <string.h>

const char *fe_output_name(const ff_port *input)
{
    return strchr(input->name, '.') + 1;
}

const ff_wire *fe_input_wire(const ff_stage *stage, size_t input)
{
    assert(input < stage->loaded->model->input_count && stage->wire_count > 0);
    const ff_port *row = ff_model_input(stage->loaded->model, input);
    size_t i = 0;
    while (!fe_is_on_wire(row->name, stage->wires[i].name)) {
        i++;
        assert(i < stage->wire_count);
    }
    return &stage->wires[i];
}

bool fe_is_fed_back(const ff_stage *stage, size_t input)
{
    return stage->wire_count > 0 && fe_input_wire(stage, input)->closes;
}

int fe_find_offer(const ff_loaded *from, const ff_port *input)
{
    for (size_t i = 0; i < from->model->output_count; i++) {
        const ff_port *row = ff_model_output(from->model, i);
        bool alike = !row->service == !input->service;
        if (alike && (row->service ? !strcmp(row->service, input->service)
                                   : !strcmp(row->name, fe_output_name(input))))
            return (int)i;
    }
    return -1;
}

ff_result *ff_feeding_result(const ff_pipeline *pipeline, const ff_stage *stage, size_t input)
{
    const ff_port *row = ff_model_input(stage->loaded->model, input);
    const ff_wire *wire = stage->wire_count ? fe_input_wire(stage, input) : NULL;
    if (row->service || !wire || wire->stage < 0 || !pipeline->stages[wire->stage].loaded)
        return NULL;
    const ff_stage *from = &pipeline->stages[wire->stage];
    int output = fe_find_offer(from->loaded, row);
    return output < 0 ? NULL : &from->results[output];
}

uint64_t fe_wanted_of(const ff_stage *stage)
{
    uint64_t wanted = 0;
    for (size_t i = 0; i < stage->loaded->model->output_count && i < 64; i++)
        wanted |= (uint64_t)stage->results[i].wanted << i;
    return wanted;
}

bool fe_wants_any(const ff_stage *stage)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++)
        if (stage->results[i].wanted)
            return true;
    return false;
}
