/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the cases ended, and how far their numbers can be trusted. */
#ifndef WRITER_NETCDF_STATUS_H
#define WRITER_NETCDF_STATUS_H

#include "file.h"

void writer_nc_find_states(writer_nc_file *f);
/* False: out of memory. */
bool writer_nc_find_lines(writer_nc_file *f);
void writer_nc_define_status(writer_nc_file *f);
void writer_nc_define_quality(writer_nc_file *f);
void writer_nc_write_status(writer_nc_file *f, size_t index, const writer_nc_slab *at);
void writer_nc_write_quality(writer_nc_file *f, size_t index, const writer_nc_slab *at);

#endif
