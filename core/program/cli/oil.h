/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of an oil that need no run. */
#ifndef CLI_OIL_H
#define CLI_OIL_H

#include "session.h"

/* Reports temperatures of an oil that are given in two places and differ, with both places. */
void cli_check_temperatures(cli_session *session);

/* Reports errors of the oils that a run of the pipeline would find. `oils` is a second run of the
 * file that has only its oil stages; its messages are these errors. */
void cli_check_oil(cli_session *session, ff_run *oils);

#endif
