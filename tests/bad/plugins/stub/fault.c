/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fault FAULT of a model of kind KIND, whose code stands in a library. No header is read: there
   are many of these. */
extern const char stub_fault[], stub_id[];
const char stub_fault[] = FAULT;
const char stub_id[] = KIND "/" FAULT;
