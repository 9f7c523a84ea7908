#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "jostle/disk/hdf5_objects.hpp"

namespace jostle {

// The building blocks of an H5MD file; all of them throw Hdf5Failure.

using Sizes = std::vector<hsize_t>;

/// A text of fixed length, because H5MD asks for it, and because variable ones lie where HDF5 keeps no checksum.
Hdf5Id text_type(std::size_t size);

Hdf5Id make_group(hid_t parent, const char* name);

/// An attribute of shape `sizes`; no sizes: a scalar.
void put_attribute(hid_t object, const char* name, hid_t type, const Sizes& sizes, const void* value);
void put_text_attribute(hid_t object, const char* name, const std::string& text);

/// The attribute "unit", unless it is empty.
void put_unit(hid_t dataset, const std::string& unit);

/// A small dataset of shape `sizes` within its object header, whose checksum then covers it.
void put_compact(hid_t parent, const char* name, hid_t type, const Sizes& sizes, const void* value,
                 const std::string& unit = "");

/// A text as a scalar dataset, or one of shape [1] if it is longer than an object header can hold.
void put_text(hid_t parent, const char* name, const std::string& text);

/// A dataset [T][...] of which one frame after another is written; chunked, every chunk with its checksum.
class FrameDataset {
public:
    /// `fill` is the value of rows that are never written; nullptr: zero.
    FrameDataset(hid_t parent, const char* name, hid_t type, Sizes sizes, const void* fill, const std::string& unit);

    /// Writes the first `rows` rows (rods) of frame `frame`; the rest of the frame keeps the fill value.
    void write(hsize_t frame, hsize_t rows, const void* values);

    hid_t id() const { return dataset_; }

private:
    Hdf5Id make(hid_t parent, const char* name, const void* fill) const;

    hid_t type_;
    Sizes sizes_;
    Hdf5Id dataset_;
};

/// An H5MD element: a group of value, step and time; time is the dimension scale of axis 0.
class TimedElement {
public:
    TimedElement(hid_t parent, const char* name, hid_t type, const Sizes& sizes, const void* fill,
                 const std::string& unit, const std::string& time_unit);

    void write(hsize_t frame, std::uint64_t step, double time, hsize_t rows, const void* values);

    /// The values of another element sampled at the same times: its step and time are hard links to this one's, as
    /// H5MD demands of image and box.
    FrameDataset beside(hid_t parent, const char* name, hid_t type, const Sizes& sizes, const void* fill,
                        const std::string& unit) const;

private:
    Hdf5Id group_;
    FrameDataset step_, time_, value_;
};

}  // namespace jostle
