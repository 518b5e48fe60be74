/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dimensions and variables of the results. */
#ifndef WRITER_NETCDF_DEFINE_H
#define WRITER_NETCDF_DEFINE_H

#include "file.h"

/* Dimension `which` of a variable, or NULL where no case has the variable. */
writer_nc_dim *writer_nc_dimension(const writer_nc_file *f, const ff_view_variable *variable,
                                   uint32_t which);
void writer_nc_measure(writer_nc_file *f);
void writer_nc_share_dimensions(writer_nc_file *f);
void writer_nc_define_study(writer_nc_file *f);
void writer_nc_define_axes(writer_nc_file *f);
void writer_nc_define_dimensions(writer_nc_file *f);
void writer_nc_define_variable(writer_nc_file *f, size_t v);

#endif
