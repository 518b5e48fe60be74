/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be said of an oil without a run. */
#ifndef CLI_OIL_H
#define CLI_OIL_H

#include "session.h"

/* Reports temperatures of an oil that stand in two places and differ, with both places. */
void cli_check_temperatures(cli_session *session);

/* Reports what a run of the pipeline would refuse of its oils. `oils`: the same file once more, of
   which these alone are run; what is wrong about them is in its messages. */
void cli_check_oil(cli_session *session, ff_run *oils);

#endif
