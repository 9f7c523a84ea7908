#include "bindings/simulation.hpp"
#include "jostle/measurement/h5md_attributes.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/scene_file/scene_writer.hpp"

namespace jostle::python {

namespace {

H5mdAttributes attributes_of(const Scene& scene) {
    H5mdAttributes attributes = h5md_attributes(scene);
    attributes.scene = attributes.resolved_scene = to_toml(scene);
    attributes.command_line = "jostle.Simulation.record";
    return attributes;
}

}  // namespace

std::size_t SimulationInPython::record(const std::string& journal, std::uint64_t every) {
    require_between_steps();
    recordings_.push_back({TrajectoryJournal::create(journal), journal, every});
    append_frame(recordings_.back());
    return recordings_.size() - 1;
}

void SimulationInPython::append_frame(Recording& recording) {
    if (!recording.journal) return;
    recording.journal->append(simulation_.clock().step, simulation_.clock().time, simulation_.box(),
                              simulation_.rods());
    ++recording.frames;
}

std::size_t SimulationInPython::frames_of(std::size_t recording) const {
    require_rest();
    return recordings_.at(recording).frames;
}

void SimulationInPython::end_recording(std::size_t recording, const std::string& h5md) {
    require_between_steps();
    Recording& ended = recordings_.at(recording);
    ended.journal.reset();
    if (!h5md.empty()) write_h5md(ended.path, h5md, attributes_of(scene_.scene), &measurement_.series());
}

}  // namespace jostle::python
