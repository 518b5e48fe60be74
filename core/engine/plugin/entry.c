/* SPDX-License-Identifier: MIT */
/* Finds the model with a given id among those that a shared object exports. */
#include "private.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

enum { MOST_MODELS = 1000 };

typedef const ff_model *one_model(void);
typedef const ff_model *const *list_of_models(void);

/* Returns NULL, or a description of the fault of entry `index` of the list; the earlier entries are
   correct. */
static const char *find_fault(const ff_model *const *list, size_t index)
{
    const ff_model *model = list[index];
    if (index == MOST_MODELS)
        return "gives a list of more than 1000 models: perhaps no NULL ends it";
    if (!FF_HAS(model, id) || !model->id)
        return "gives a list with a model that has no id";
    for (size_t i = 0; i < index; i++)
        if (!strcmp(list[i]->id, model->id))
            return "gives a list that has one id twice";
    return NULL;
}

static const ff_model *find_in_list(const ff_model *const *list, const char *id, char *why,
                                    size_t why_size)
{
    const ff_model *found = NULL;
    const char *fault =
        list ? list[0] ? NULL : "gives an empty list of models" : "gives no list of models";
    char ids[400] = "";
    for (size_t i = 0, at = 0; !fault && list[i]; i++) {
        fault = find_fault(list, i);
        if (!fault && !strcmp(list[i]->id, id))
            found = list[i];
        if (!fault && at < sizeof ids)
            at +=
                (size_t)snprintf(ids + at, sizeof ids - at, "%s%.60s", i ? ", " : "", list[i]->id);
    }
    if (fault)
        snprintf(why, why_size, "%s", fault);
    else if (!found)
        snprintf(why, why_size, "has the models %s, but its place says \"%s\"", ids, id);
    return fault ? NULL : found;
}

bool fe_entry_find(void *object, const char *id, const ff_model **model, char *why, size_t why_size)
{
    one_model *one;
    list_of_models *list;
    *(void **)(void *)&one = dlsym(object, "flankfilm_model_v1");
    *(void **)(void *)&list = dlsym(object, "flankfilm_models_v1");
    if (one && list) {
        snprintf(why, why_size,
                 "has both functions flankfilm_model_v1 and flankfilm_models_v1; a plugin may have "
                 "only one");
        return false;
    }
    if (!one && !list) {
        snprintf(why, why_size,
                 "has no function flankfilm_model_v1 or flankfilm_models_v1: it is not a flankfilm "
                 "plugin, or one for another version of the interface");
        return false;
    }
    *model = one ? one() : find_in_list(list(), id, why, why_size);
    return one || *model;
}
