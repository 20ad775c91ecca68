// Adds arrays to the points of a snapshot, as later solvers and other programs may.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/h5/h5.h"

namespace cleft {

/// /VTKHDF/PointData/<name> of shape {rows} or {rows, components}; of integers where the type is set.
inline void add_point_array(const std::string& snapshot, const std::string& name,
                            const std::vector<double>& values, const h5::Shape& shape,
                            hid_t type = H5T_NATIVE_DOUBLE) {
  const h5::Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  const h5::Handle file(H5Fopen(snapshot.c_str(), H5F_ACC_RDWR, access), H5Fclose);
  const h5::Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const h5::Handle dataset(H5Dcreate2(file, ("/VTKHDF/PointData/" + name).c_str(), type, space, H5P_DEFAULT,
                                      H5P_DEFAULT, H5P_DEFAULT),
                           H5Dclose);
  ASSERT_GE(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
}

}  // namespace cleft
