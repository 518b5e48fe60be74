/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "write.h"
#include "derived-files.h"

bool results_write_run(const results_outcome *outcome, const char *directory,
                       results_folder *folder, char **removed)
{
    results_write_arrays(outcome, folder);
    FILE *stream = results_folder_begin(folder, "result", ".json");
    if (stream)
        results_write_run_json(outcome, stream);
    if (!results_folder_end(folder))
        return results_folder_commit(folder); /* removes the temporary files */
    *removed = results_made_remove(directory);
    return results_folder_commit(folder);
}
