/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of a study beside its journal: each is there whole, or as it was. */
#include "private.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char ff_study_description[] = "study.json";

bool ff_put_file(const char *directory, const char *name, const char *text, const char *hint,
                 ff_report *report)
{
    char *path = ff_print_text("%s/%s", directory, name);
    char *part = ff_print_text("%s.%ld.part", path, (long)getpid()); /* shards write the same */
    FILE *out = fopen(part, "we");
    bool good = out && fputs(text, out) >= 0 && fflush(out) == 0 && fsync(fileno(out)) == 0;
    if (out)
        good = fclose(out) == 0 && good;
    good = good && rename(part, path) == 0;
    if (!good) {
        int cause = errno;
        unlink(part);
        ff_error(report, FF_EXIT_FAILED, FF_NOWHERE, hint, "%s could not be written: %s", path,
                 strerror(cause));
    }
    free(path);
    free(part);
    return good;
}

bool ff_describe(const ff_campaign *campaign, ff_report *report)
{
    char *text = NULL;
    size_t length = 0;
    if (!campaign->describe)
        return true;
    FILE *out = ff_there(open_memstream(&text, &length));
    campaign->describe(campaign->ctx, campaign->described, out);
    fclose(out);
    bool good = ff_put_file(campaign->directory, ff_study_description, text, NULL, report);
    free(text);
    return good;
}
