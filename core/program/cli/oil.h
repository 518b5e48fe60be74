/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of an oil that need no run. */
#ifndef CLI_OIL_H
#define CLI_OIL_H

#include "session.h"

/* Reports temperatures of an oil that are given in two places and differ, with both places. */
void cli_check_temperatures(cli_session *session);

/* Reports what a run of the pipeline would refuse about its oils. `oils` is a second reading of
 * the file, of which only the oils are run; its messages say what is wrong with them. */
void cli_check_oil(cli_session *session, ff_run *oils);

#endif
