#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "jostle/run_files/series_file.hpp"

namespace jostle {

/// What an H5MD file tells about its run, beside the frames.
struct H5mdAttributes {
    std::string author = "unknown";  ///< the person's name
    std::string version;             ///< of jostle
    std::string scene;               ///< the user's text, verbatim
    std::string resolved_scene;      ///< with every default spelled out
    std::uint64_t seed = 0;
    std::string command_line;
    std::string host;
    std::string unit_system;  ///< "SI" where the units below are SI units with prefixes, else the set's own name
    std::string length_unit;  ///< factors separated by spaces, signed powers: "um"; empty: no unit is written
    std::string time_unit;
    std::string stress_unit;
    std::string energy_unit;                     ///< of stress times volume
    std::function<double(double time)> kT = {};  ///< of Brownian motion; empty: no orientation stress is written
};

/// Makes an H5MD 1.1 file (P. de Buyl et al., Comput. Phys. Commun. 185, 1546 (2014)) from a journal.
///
/// One frame is in memory at a time. The file is written beside its place and renamed into it when it is whole and
/// on the disk. Its numbers carry fletcher32 checksums and its structure HDF5's own (file format of HDF5 1.10).
/// Where N varies, the rows that are not there have id -1 (the fill value) and NaN.
/// A journal with stress gives each rod its part of the collision stress and, at the frame's axes, its orientation
/// stress.
/// series: if given, /observables/stress_collision and stress_orientation are made from its columns step, time,
/// stress_xx ... stress_zz and stress_orientation_xx ... stress_orientation_zz.
/// Errors: InputError for a missing or damaged journal; DiskError, and the old file is still there.
void write_h5md(const std::string& journal_path, const std::string& h5md_path, const H5mdAttributes& attributes,
                const SeriesTable* series = nullptr);

/// Appends the seal: 8 bytes "\x89JH5MD\r\n", the number of bytes before it (u64) and their XXH3 checksum (u64).
///
/// HDF5 looks at no byte beyond its own end of file, so every reader still opens the file; a program that writes into
/// it removes the seal. Errors: DiskError.
void seal_h5md(const std::string& path);

/// Compares a file of write_h5md with its seal, then reads every dataset through.
///
/// A file without a seal, as another program leaves it that added to it, is checked by HDF5's own checksums alone.
/// Errors: InputError that says what is damaged, or that it is no such file; DiskError.
void verify_h5md(const std::string& path);

}  // namespace jostle
