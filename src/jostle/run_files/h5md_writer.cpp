#include "jostle/run_files/h5md_writer.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <optional>
#include <vector>

#include "jostle/disk/durable_file.hpp"
#include "jostle/disk/hdf5_objects.hpp"
#include "jostle/run_files/h5md_element.hpp"
#include "jostle/run_files/trajectory_journal.hpp"
#include "jostle/stress/column_names.hpp"
#include "jostle/stress/orientation_stress.hpp"

namespace jostle {
namespace {

constexpr std::int64_t no_rod = -1;

/// What must be known before the first dataset is made.
struct JournalShape {
    hsize_t frames = 0;
    hsize_t largest_count = 0;
    bool has_stress = false;
    bool box_varies = false;
    bool is_sheared = false;  // in any frame
    Box box;                  // of the first frame
};

JournalShape shape_of(const std::string& journal_path) {
    JournalShape shape;
    TrajectoryReader reader(journal_path);
    shape.has_stress = reader.content() == TrajectoryJournal::Content::rods_and_stress;
    for (TrajectoryFrame frame; reader.next(frame); ++shape.frames) {
        if (shape.frames == 0) shape.box = frame.box;
        shape.box_varies = shape.box_varies || !(frame.box.edges() == shape.box.edges());
        shape.is_sheared = shape.is_sheared || frame.box.offset() != 0.0;
        shape.largest_count = std::max<hsize_t>(shape.largest_count, frame.size());
    }
    return shape;
}

void put_version(hid_t object, int major, int minor) {
    const std::array<int, 2> version = {major, minor};
    put_attribute(object, "version", H5T_NATIVE_INT, {2}, version.data());
}

void write_metadata(hid_t file, const H5mdAttributes& attributes) {
    const Hdf5Id h5md = make_group(file, "h5md");
    put_version(h5md, 1, 1);
    put_text_attribute(make_group(h5md, "author"), "name", attributes.author);
    const Hdf5Id creator = make_group(h5md, "creator");
    put_text_attribute(creator, "name", "jostle");
    put_text_attribute(creator, "version", attributes.version);
    const Hdf5Id modules = make_group(h5md, "modules");
    const Hdf5Id units = make_group(modules, "units");
    put_version(units, 1, 0);
    put_text_attribute(units, "system", attributes.unit_system);
}

void write_parameters(hid_t file, const H5mdAttributes& attributes) {
    const Hdf5Id parameters = make_group(file, "parameters");
    put_text(parameters, "scene", attributes.scene);
    put_text(parameters, "resolved_scene", attributes.resolved_scene);
    put_compact(parameters, "seed", H5T_NATIVE_UINT64, {}, &attributes.seed);
    put_text(parameters, "version", attributes.version);
    put_text(parameters, "command_line", attributes.command_line);
    put_text(parameters, "host", attributes.host);
}

Hdf5Id write_box(hid_t rods, const JournalShape& shape, const H5mdAttributes& attributes) {
    Hdf5Id box = make_group(rods, "box");
    const int dimension = 3;
    put_attribute(box, "dimension", H5T_NATIVE_INT, {}, &dimension);
    constexpr std::size_t width = 8;  // of "periodic"
    std::string boundary;
    for (const bool periodic : shape.box.periodic())
        boundary += periodic ? "periodic" : std::string("none\0\0\0\0", width);
    put_attribute(box, "boundary", text_type(width), {3}, boundary.data());
    if (!shape.box_varies && !shape.is_sheared)
        put_compact(box, "edges", H5T_NATIVE_DOUBLE, {3}, &shape.box.edges(), attributes.length_unit);
    return box;
}

/// A row each, as H5MD has it for boxes that are not rectangular.
Mat3 edge_vectors(const Box& box) {
    const auto [x, y, z] = box.edges();
    return Mat3{{x, 0, 0, box.offset(), y, 0, 0, 0, z}};
}

std::vector<Mat3> orientation_stress_of_rods(const TrajectoryFrame& frame, double kT) {
    std::vector<Mat3> stress(frame.size());
    for (std::size_t i = 0; i < stress.size(); ++i) {
        const auto& [x, y, z] = frame.axis[i];
        stress[i] =
            orientation_stress_of_rod({x, y, z}, frame.length[i], frame.diameter[i], kT, frame.box.dimensions());
    }
    return stress;
}

void write_particles(hid_t file, const std::string& journal_path, const JournalShape& shape,
                     const H5mdAttributes& attributes) {
    const Hdf5Id particles = make_group(file, "particles");
    const Hdf5Id rods = make_group(particles, "rods");
    const Hdf5Id box = write_box(rods, shape, attributes);
    const hsize_t t = shape.frames, n = shape.largest_count;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::string& unit = attributes.length_unit;

    TimedElement position(rods, "position", H5T_NATIVE_FLOAT, {t, n, 3}, &nan, unit, attributes.time_unit);
    FrameDataset image = position.beside(rods, "image", H5T_NATIVE_INT32, {t, n, 3}, nullptr, "");
    FrameDataset axis = position.beside(rods, "orientation", H5T_NATIVE_FLOAT, {t, n, 3}, &nan, "");
    FrameDataset length = position.beside(rods, "length", H5T_NATIVE_FLOAT, {t, n}, &nan, unit);
    FrameDataset diameter = position.beside(rods, "diameter", H5T_NATIVE_FLOAT, {t, n}, &nan, unit);
    FrameDataset id = position.beside(rods, "id", H5T_NATIVE_INT64, {t, n}, &no_rod, "");
    std::optional<FrameDataset> collision, orientation, edges;
    const auto of_stress = [&](const char* name) {
        const double none = std::numeric_limits<double>::quiet_NaN();
        return position.beside(rods, name, H5T_NATIVE_DOUBLE, {t, n, 3, 3}, &none, attributes.energy_unit);
    };
    if (shape.has_stress) collision = of_stress("stress_collision");
    if (shape.has_stress && attributes.kT) orientation = of_stress("stress_orientation");
    if (shape.is_sheared)
        edges = position.beside(box, "edges", H5T_NATIVE_DOUBLE, {t, 3, 3}, nullptr, unit);
    else if (shape.box_varies)
        edges = position.beside(box, "edges", H5T_NATIVE_DOUBLE, {t, 3}, nullptr, unit);

    TrajectoryReader reader(journal_path);
    TrajectoryFrame frame;
    for (hsize_t k = 0; k < shape.frames && reader.next(frame); ++k) {
        const hsize_t count = frame.size();
        position.write(k, frame.step, frame.time, count, frame.centre.data());
        image.write(k, count, frame.image.data());
        axis.write(k, count, frame.axis.data());
        length.write(k, count, frame.length.data());
        diameter.write(k, count, frame.diameter.data());
        id.write(k, count, frame.id.data());  // ids count from 0 and stay far below 2^63
        if (collision) collision->write(k, count, frame.stress.data());
        if (orientation)
            orientation->write(k, count, orientation_stress_of_rods(frame, attributes.kT(frame.time)).data());
        if (edges && shape.is_sheared)
            edges->write(k, 3, edge_vectors(frame.box).m.data());
        else if (edges)
            edges->write(k, 3, &frame.box.edges());
    }
}

/// One tensor of each row of the series, from its nine columns.
void write_tensor(hid_t observables, const char* name, const std::array<const char*, 9>& columns,
                  const SeriesTable& series, const H5mdAttributes& attributes) {
    std::array<const std::vector<double>*, 9> entries;
    for (std::size_t k = 0; k < 9; ++k) entries[k] = &series.column(columns[k]);
    const std::vector<double>& step = series.column("step");
    const std::vector<double>& time = series.column("time");
    TimedElement tensor(observables, name, H5T_NATIVE_DOUBLE, {series.rows(), 3, 3}, nullptr, attributes.stress_unit,
                        attributes.time_unit);
    for (std::size_t row = 0; row < series.rows(); ++row) {
        std::array<double, 9> value;
        for (std::size_t k = 0; k < 9; ++k) value[k] = (*entries[k])[row];
        tensor.write(row, static_cast<std::uint64_t>(step[row]), time[row], 3, value.data());
    }
}

void write_stress(hid_t file, const SeriesTable& series, const H5mdAttributes& attributes) {
    const Hdf5Id observables = make_group(file, "observables");
    const auto& [xx, xy, xz, yy, yz, zz] = orientation_stress_column_names;
    write_tensor(observables, "stress_collision", stress_column_names, series, attributes);
    write_tensor(observables, "stress_orientation", {xx, xy, xz, xy, yy, yz, xz, yz, zz}, series, attributes);
}

void write_file(const std::string& path, const std::string& journal_path, const JournalShape& shape,
                const H5mdAttributes& attributes, const SeriesTable* series) {
    const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), "make the file");
    // The structures of HDF5 1.10 carry checksums, the older ones do not. Close everything with the file.
    hdf5_checked(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "choose the file format");
    hdf5_checked(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "choose the file format");
    Hdf5Id file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "make the file");
    write_metadata(file, attributes);
    write_particles(file, journal_path, shape, attributes);
    if (series) write_stress(file, *series, attributes);
    write_parameters(file, attributes);
    file.close("write the file");
}

}  // namespace

void write_h5md(const std::string& journal_path, const std::string& h5md_path, const H5mdAttributes& attributes,
                const SeriesTable* series) {
    const QuietHdf5 quiet;
    const JournalShape shape = shape_of(journal_path);
    const std::string temporary = h5md_path + ".tmp";
    remove_file_if_present(temporary);  // what a link of that name leads to is no file of the run
    try {
        write_file(temporary, journal_path, shape, attributes, series);
        seal_h5md(temporary);
        rename_file(temporary, h5md_path);
    } catch (const Hdf5Failure& failure) {
        remove_file_if_present(temporary);
        if (failure.is_out_of_memory()) throw std::bad_alloc();
        if (failure.error_number != 0) throw DiskError(h5md_path, failure.operation, failure.error_number);
        throw DiskError(h5md_path, failure.operation, "HDF5: " + failure.reason);
    } catch (...) {
        remove_file_if_present(temporary);
        throw;
    }
    sync_folder(folder_of(h5md_path));
}

}  // namespace jostle
