/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the study is, for those who read its directory. Shards write the same. */
#include "private.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

const char ff_study_description[] = "study.json";

bool ff_describe(const ff_campaign *campaign, int directory, ff_report *report)
{
    char part[64];
    if (!campaign->describe)
        return true;
    snprintf(part, sizeof part, "%s.%ld.part", ff_study_description, (long)getpid());
    int fd = openat(directory, part, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    FILE *out = fd < 0 ? NULL : fdopen(fd, "w");
    bool good = out != NULL;
    if (out) {
        campaign->describe(campaign->ctx, campaign->described, out);
        good = fflush(out) == 0 && !ferror(out) && fsync(fd) == 0;
        good = fclose(out) == 0 && good;
    }
    if (good && renameat(directory, part, directory, ff_study_description) == 0)
        return true;
    int cause = errno;
    unlinkat(directory, part, 0);
    return ff_error(report, FF_EXIT_FAILED, FF_NOWHERE, NULL, "%s/%s could not be written: %s",
                    campaign->directory, ff_study_description, strerror(cause));
}
