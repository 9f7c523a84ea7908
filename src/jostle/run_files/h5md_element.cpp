#include "jostle/run_files/h5md_element.hpp"

#include <hdf5_hl.h>

#include <algorithm>
#include <utility>

namespace jostle {
namespace {

constexpr std::size_t largest_compact = 60000;  // HDF5 keeps at most 64 KiB in an object's header
constexpr hsize_t chunk_bytes = 1 << 16;
constexpr hsize_t largest_row_chunk = 1 << 16;

Hdf5Id space_of(const Sizes& sizes) {
    if (sizes.empty()) return {H5Screate(H5S_SCALAR), "make a dataspace"};
    return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), "make a dataspace"};
}

/// Chunks of about 64 KiB, and no longer along the rods than 65536, so that one frame can be read alone.
Sizes chunk_of(const Sizes& sizes, std::size_t element_bytes) {
    Sizes chunk = sizes;
    hsize_t row = element_bytes;
    for (std::size_t k = 1; k < chunk.size(); ++k) {
        chunk[k] = std::clamp<hsize_t>(chunk[k], 1, largest_row_chunk);
        row *= chunk[k];
    }
    chunk[0] = std::clamp<hsize_t>(chunk_bytes / row, 1, std::max<hsize_t>(sizes[0], 1));
    return chunk;
}

}  // namespace

Hdf5Id text_type(std::size_t size) {
    Hdf5Id type(H5Tcopy(H5T_C_S1), "make a text type");
    hdf5_checked(H5Tset_size(type, std::max<std::size_t>(size, 1)), "make a text type");
    hdf5_checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "make a text type");
    hdf5_checked(H5Tset_cset(type, H5T_CSET_UTF8), "make a text type");
    return type;
}

Hdf5Id make_group(hid_t parent, const char* name) {
    return {H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "make a group"};
}

void put_attribute(hid_t object, const char* name, hid_t type, const Sizes& sizes, const void* value) {
    const Hdf5Id attribute(H5Acreate2(object, name, type, space_of(sizes), H5P_DEFAULT, H5P_DEFAULT),
                           "make an attribute");
    hdf5_checked(H5Awrite(attribute, type, value), "write an attribute");
}

void put_text_attribute(hid_t object, const char* name, const std::string& text) {
    put_attribute(object, name, text_type(text.size()), {}, text.c_str());
}

void put_unit(hid_t dataset, const std::string& unit) {
    if (!unit.empty()) put_text_attribute(dataset, "unit", unit);
}

void put_compact(hid_t parent, const char* name, hid_t type, const Sizes& sizes, const void* value,
                 const std::string& unit) {
    const Hdf5Id properties(H5Pcreate(H5P_DATASET_CREATE), "make a dataset");
    hdf5_checked(H5Pset_layout(properties, H5D_COMPACT), "make a dataset");
    const Hdf5Id dataset(H5Dcreate2(parent, name, type, space_of(sizes), H5P_DEFAULT, properties, H5P_DEFAULT),
                         "make a dataset");
    hdf5_checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value), "write a dataset");
    put_unit(dataset, unit);
}

void put_text(hid_t parent, const char* name, const std::string& text) {
    const Hdf5Id type = text_type(text.size());
    if (text.size() <= largest_compact) return put_compact(parent, name, type, {}, text.c_str());
    FrameDataset(parent, name, type, {1}, nullptr, "").write(0, 1, text.c_str());
}

FrameDataset::FrameDataset(hid_t parent, const char* name, hid_t type, Sizes sizes, const void* fill,
                           const std::string& unit)
    : type_(type), sizes_(std::move(sizes)), dataset_(make(parent, name, fill)) {
    put_unit(dataset_, unit);
}

void FrameDataset::write(hsize_t frame, hsize_t rows, const void* values) {
    if (rows == 0) return;
    Sizes start(sizes_.size(), 0), count = sizes_;
    start[0] = frame;
    count[0] = 1;
    if (count.size() > 1) count[1] = rows;
    const Hdf5Id file_space(H5Dget_space(dataset_), "write a dataset");
    hdf5_checked(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
                 "write a dataset");
    hdf5_checked(H5Dwrite(dataset_, type_, space_of(count), file_space, H5P_DEFAULT, values), "write a dataset");
}

Hdf5Id FrameDataset::make(hid_t parent, const char* name, const void* fill) const {
    const Hdf5Id properties(H5Pcreate(H5P_DATASET_CREATE), "make a dataset");
    const Sizes chunk = chunk_of(sizes_, H5Tget_size(type_));
    hdf5_checked(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), "make a dataset");
    hdf5_checked(H5Pset_fletcher32(properties), "make a dataset");
    if (fill) hdf5_checked(H5Pset_fill_value(properties, type_, fill), "make a dataset");
    // H5MD: the first dimension can grow, should someone add frames.
    Sizes largest = sizes_;
    largest[0] = H5S_UNLIMITED;
    const Hdf5Id space(H5Screate_simple(static_cast<int>(sizes_.size()), sizes_.data(), largest.data()),
                       "make a dataset");
    return {H5Dcreate2(parent, name, type_, space, H5P_DEFAULT, properties, H5P_DEFAULT), "make a dataset"};
}

TimedElement::TimedElement(hid_t parent, const char* name, hid_t type, const Sizes& sizes, const void* fill,
                           const std::string& unit, const std::string& time_unit)
    : group_(make_group(parent, name)),
      step_(group_, "step", H5T_NATIVE_INT64, {sizes[0]}, nullptr, ""),
      time_(group_, "time", H5T_NATIVE_DOUBLE, {sizes[0]}, nullptr, time_unit),
      value_(group_, "value", type, sizes, fill, unit) {
    hdf5_checked(H5DSset_scale(time_.id(), "time"), "make the time scale");
    hdf5_checked(H5DSattach_scale(value_.id(), time_.id(), 0), "attach the time scale");
    hdf5_checked(H5DSattach_scale(step_.id(), time_.id(), 0), "attach the time scale");
}

void TimedElement::write(hsize_t frame, std::uint64_t step, double time, hsize_t rows, const void* values) {
    const auto signed_step = static_cast<std::int64_t>(step);
    step_.write(frame, 1, &signed_step);
    time_.write(frame, 1, &time);
    value_.write(frame, rows, values);
}

FrameDataset TimedElement::beside(hid_t parent, const char* name, hid_t type, const Sizes& sizes, const void* fill,
                                  const std::string& unit) const {
    const Hdf5Id group = make_group(parent, name);
    for (const char* shared : {"step", "time"})
        hdf5_checked(H5Lcreate_hard(group_, shared, group, shared, H5P_DEFAULT, H5P_DEFAULT), "link step and time");
    FrameDataset value(group, "value", type, sizes, fill, unit);
    hdf5_checked(H5DSattach_scale(value.id(), time_.id(), 0), "attach the time scale");
    return value;
}

}  // namespace jostle
