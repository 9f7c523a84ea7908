#include "jostle/measurement/h5md_attributes.hpp"

#include "jostle/run_files/version.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/scene/units.hpp"

namespace jostle {

H5mdAttributes h5md_attributes(const Scene& scene) {
    H5mdAttributes attributes;
    attributes.version = program_version;
    attributes.seed = scene.seed;
    attributes.unit_system = scene.units.system == UnitSystem::micro ? "SI" : "reduced";
    attributes.length_unit = unit_of(scene, dimension::length);
    attributes.time_unit = unit_of(scene, dimension::time);
    attributes.stress_unit = unit_of_stress(scene);
    attributes.energy_unit = unit_of(scene, dimension::energy);
    if (thermal_energy(scene_at_its_hardest(scene)) > 0.0)
        attributes.kT = [scene](double time) { return thermal_energy(scene_at(scene, time)); };
    return attributes;
}

}  // namespace jostle
