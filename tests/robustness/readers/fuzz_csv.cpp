// CSV files: rods and springs of a scene, contacts and bodies of other programs, a series. The first byte says which.
#include "jostle/run_files/series_file.hpp"
#include "jostle/scene_file/rods_file.hpp"
#include "jostle/scene_file/springs_file.hpp"
#include "jostle/tables/body_table.hpp"
#include "jostle/tables/contact_table.hpp"
#include "reader_target.hpp"

namespace {

jostle::BodyTable three_bodies() {
    const fuzzing::MemoryFile file("id,x,y,z,shape,diameter\n0,0,0,0,sphere,1\n1,1,0,0,sphere,1\n2,0,1,0,sphere,1\n");
    return jostle::read_bodies(file.path());
}

void read(std::uint8_t kind, const std::string& path) {
    static const jostle::BodyTable bodies = three_bodies();
    static const jostle::Box box{{4, 4, 4}, {true, true, true}};
    switch (kind % 5) {
        case 0:
            (void)jostle::read_rods(path, 2.0, 1.0);
            break;
        case 1:
            (void)jostle::read_springs(path, 3, [](std::uint64_t) { return 2.0; });
            break;
        case 2:
            (void)jostle::read_contacts(path, bodies, box);
            break;
        case 3:
            (void)jostle::read_bodies(path);
            break;
        default:
            (void)jostle::read_series(path);
            break;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    if (size == 0) return 0;
    const fuzzing::MemoryFile file(fuzzing::text(bytes + 1, size - 1));
    return fuzzing::read_or_refuse([&] { read(bytes[0], file.path()); });
}
