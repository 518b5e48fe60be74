/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Attributes of the whole file: where its numbers come from. */
#ifndef WRITER_NETCDF_ORIGIN_H
#define WRITER_NETCDF_ORIGIN_H

#include "file.h"

void writer_nc_define_globals(writer_nc_file *f);

#endif
