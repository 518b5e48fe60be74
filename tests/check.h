/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks that count their failures and go on. Return check_done() from main. */
#ifndef TEST_CHECK_H
#define TEST_CHECK_H

int check_near(const char *what, double value, double expected, double relative);
int check_below(const char *what, double value, double limit);
int check_true(const char *what, int condition);
int check_done(void); /* prints the figures; 0 when there were checks and all held */

#endif
