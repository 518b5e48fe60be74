/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records the settings that the program chose to reach the requested accuracy. */
#include "study.h"

#include "../../memory/memory.h"

#include <stdlib.h>
#include <string.h>

json_t *study_settings_record(const char *const *assignments, size_t count)
{
    json_t *all = json_object();
    for (size_t i = 0; i < count; i++) {
        const char *value = strchr(assignments[i], '=') + 1;
        char *path = memory_print_text("%.*s", (int)(value - 1 - assignments[i]), assignments[i]);
        json_object_set_new(all, path, json_string(value));
        free(path);
    }
    return all;
}
