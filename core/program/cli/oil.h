/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be said of an oil without a run. */
#ifndef CLI_OIL_H
#define CLI_OIL_H

#include "session.h"

/* Reports temperatures of an oil that stand in two places and differ, with both places. */
void cli_check_temperatures(cli_session *session);

/* Reports what a run of the pipeline would refuse of its oils. `tree`: the same file once more,
   which is changed. What is wrong about the oils themselves goes to `report`, whose sources are the
   tree's. */
void cli_check_oil(cli_session *session, ff_tree *tree, ff_report *report);

#endif
