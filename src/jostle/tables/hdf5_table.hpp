#pragma once

#include "jostle/tables/table.hpp"

namespace jostle {

/// `read_table` of an HDF5 file.
Table read_hdf5_table(const std::string& path, const KnownColumns& known);

}  // namespace jostle
