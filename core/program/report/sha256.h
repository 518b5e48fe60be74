/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the SHA-256 of a text. A page's policy identifies its scripts by it. */
#ifndef REPORT_SHA256_H
#define REPORT_SHA256_H

#include <stddef.h>

enum { SHA256_BASE64 = 45 };

/* Writes the SHA-256 of a text in base64, as a Content-Security-Policy names it. */
void sha256_base64(const char *text, size_t length, char out[SHA256_BASE64]);

#endif
