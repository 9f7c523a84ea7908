// Metropolis Monte Carlo of hard spherocylinders, D = kT = 1, in a cubic periodic box. monte_carlo.py compiles it, runs
// it and judges what it prints.
//
//     monte_carlo LENGTH COUNT SEED < states > measurements
//
// A state is one line: volume fraction, sweeps to equilibrate, sweeps to measure, file for the last configuration. The
// first state starts from columns along x; each other one from the last configuration of the state before, which is
// expanded or, bit by bit, compressed to the new density. A measurement is one line: volume fraction, nematic order S,
// and how many pairs of rods first touch in each bin of the compression e, if places shrink by 1 - e.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

// In place of Eigen's, for the compiler makes one loop over rods of it.
struct Vector {
    double x = 0, y = 0, z = 0;
};
Vector operator+(Vector u, Vector v) {
    return {u.x + v.x, u.y + v.y, u.z + v.z};
}
Vector operator-(Vector u, Vector v) {
    return {u.x - v.x, u.y - v.y, u.z - v.z};
}
Vector operator*(double s, Vector v) {
    return {s * v.x, s * v.y, s * v.z};
}
double dot(Vector u, Vector v) {
    return u.x * v.x + u.y * v.y + u.z * v.z;
}
double length(Vector v) {
    return std::sqrt(dot(v, v));
}
Vector unit(Vector v) {
    return 1 / length(v) * v;
}

constexpr double skin = 1.5;      // D; neighbours are rods nearer than 1 + skin
constexpr int sweeps_apart = 50;  // between measurements
constexpr int bins = 12;          // of the compression
constexpr double bin_width = 0.0025;

struct Rod {
    Vector place, direction;
};

// Rods column by column, so that loops over them take several at once.
struct Rods {
    explicit Rods(std::size_t count) : x(count), y(count), z(count), a(count), b(count), c(count) {}
    std::size_t size() const { return x.size(); }
    Rod operator[](std::size_t i) const { return {{x[i], y[i], z[i]}, {a[i], b[i], c[i]}}; }
    void set(std::size_t i, const Rod& rod) {
        x[i] = rod.place.x, y[i] = rod.place.y, z[i] = rod.place.z;
        a[i] = rod.direction.x, b[i] = rod.direction.y, c[i] = rod.direction.z;
    }

    std::vector<double> x, y, z, a, b, c;  // place and direction
};

double clamp(double value, double half) {
    return std::min(std::max(value, -half), half);
}

// Vector to the nearest image of the other rod, in a cube of this side.
[[gnu::always_inline]] inline Vector nearest_image(double box, Rod one, Rod other) {
    const Vector r = other.place - one.place;
    return r - box * Vector{std::nearbyint(r.x / box), std::nearbyint(r.y / box), std::nearbyint(r.z / box)};
}

// Shortest vector from one axis to another, of directions u and v, with the centre of the other r from that of the one:
// the nearest points of the lines, brought to the segments one after the other.
[[gnu::always_inline]] inline Vector shortest(double half, Vector r, Vector u, Vector v) {
    const double ru = dot(r, u), rv = dot(r, v), uv = dot(u, v);
    const double first = clamp((ru - uv * rv) / std::max(1 - uv * uv, 1e-12), half);
    const double t = clamp(first * uv - rv, half);
    const double s = clamp(t * uv + ru, half);
    return r + t * v - s * u;
}

[[gnu::always_inline]] inline double squared_distance(double box, double half, Rod one, Rod other) {
    const Vector between = shortest(half, nearest_image(box, one, other), one.direction, other.direction);
    return dot(between, between);
}

class Simulation {
public:
    // Columns along x: as many rods in a column as make the cube smallest.
    Simulation(double length, int count, std::uint64_t seed)
        : half(0.5 * length), rods(count), listed(count), squared_distances(count), random(seed) {
        box = 1e300;
        int along = 1, across = 1;
        for (int tried = 1; tried <= count; ++tried) {
            const int rows = int(std::ceil(std::sqrt(double(count) / tried)));
            const double side = 1.01 * std::max(tried * (length + 1), double(rows));
            if (side < box) box = side, along = tried, across = rows;
        }
        for (int i = 0; i < count; ++i)
            rods.set(i, {box * Vector{double(i % along) / along, double(i / along % across) / across,
                                      double(i / along / across) / across},
                         {1, 0, 0}});
        find_neighbours();
    }

    double volume_fraction() const { return double(rods.size()) * M_PI * (half / 2 + 1.0 / 6) / (box * box * box); }

    void write(const std::string& file) const {
        std::ofstream out(file);
        out.precision(17);
        out << box << '\n';
        for (std::size_t i = 0; i < rods.size(); ++i)
            out << rods.x[i] << ' ' << rods.y[i] << ' ' << rods.z[i] << ' ' << rods.a[i] << ' ' << rods.b[i] << ' '
                << rods.c[i] << '\n';
    }

    // As many trials as there are rods: translations, slides along the axis, and turns.
    void sweep() {
        for (std::size_t trial = 0; trial < rods.size(); ++trial) {
            const int i = int(random() % rods.size()), kind = int(random() % 3);
            Rod rod = rods[i];
            const Rod then = listed[i];
            if (kind == 0) rod.place = rod.place + steps[0] * in_ball();
            if (kind == 1) rod.place = rod.place + steps[1] * (2 * uniform(random) - 1) * rod.direction;
            if (kind == 2) rod.direction = unit(rod.direction + steps[2] * in_ball());
            ++tried[kind];
            if (length(rod.place - then.place) + half * length(rod.direction - then.direction) > 0.5 * skin)
                list_anew(i);
            if (overlaps(rod, neighbours[i])) continue;
            ++accepted[kind];
            rods.set(i, rod);
        }
    }

    // Sizes of trials that are accepted four times in ten, but no farther than neighbours are known.
    void adapt() {
        for (int kind = 0; kind < 3; ++kind) {
            const double factor = double(accepted[kind]) / double(std::max(1L, tried[kind])) / 0.4;
            steps[kind] =
                std::min(steps[kind] * std::clamp(factor, 0.8, 1.25), kind == 2 ? 0.4 * skin / half : 0.5 * skin);
        }
        tried = accepted = {};
    }

    // Expands at once; compresses as far as rods allow, with sweeps before each step.
    void bring_to(double fraction) {
        for (;;) {
            const double wanted = 1 - std::cbrt(volume_fraction() / fraction);
            double allowed = wanted;
            if (wanted > 0)
                for_pairs([&](double compression) { allowed = std::min(allowed, compression * (1 - 1e-9)); });
            box *= 1 - allowed;
            for (std::size_t i = 0; i < rods.size(); ++i)
                rods.set(i, {(1 - allowed) * rods[i].place, rods[i].direction});
            find_neighbours();
            if (allowed == wanted) return;
            for (int i = 0; i < 5; ++i) sweep();
        }
    }

    // S: the largest eigenvalue of 3/2 <n n> - 1/2.
    double order() const {
        Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
        for (std::size_t i = 0; i < rods.size(); ++i) {
            const Eigen::Vector3d n(rods.a[i], rods.b[i], rods.c[i]);
            moment += n * n.transpose() / double(rods.size());
        }
        return 1.5 * Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment, Eigen::EigenvaluesOnly).eigenvalues()[2] -
               0.5;
    }

    // How many pairs first touch in each bin of the compression. Ends the program if two rods overlap.
    std::array<long, bins> touching() {
        std::array<long, bins> counts{};
        find_neighbours();
        for_pairs([&](double compression) {
            if (compression < -1e-9) {
                std::cerr << "rods overlap\n";
                std::exit(1);
            }
            const int bin = int(std::max(0.0, compression) / bin_width);
            if (bin < bins) ++counts[bin];
        });
        return counts;
    }

private:
    bool overlaps(const Rod& rod, const std::vector<int>& others) const {
        const double box = this->box, half = this->half;
        double least = 2;
#pragma omp simd reduction(min : least)
        for (std::size_t k = 0; k < others.size(); ++k)
            least = std::min(least, squared_distance(box, half, rod, rods[others[k]]));
        return least < 1;
    }

    // Lists the neighbours of all rods. Two rods are neighbours if they were nearer than 1 + skin where each was listed
    // last; a rod that would move by half the skin from there is listed anew before. So rods that are no neighbours
    // cannot overlap.
    void find_neighbours() {
        neighbours.assign(rods.size(), {});
        listed = rods;
        for (std::size_t i = 0; i < rods.size(); ++i) list_anew(int(i));
    }

    void list_anew(int i) {
        for (int j : neighbours[i]) std::erase(neighbours[j], i);
        neighbours[i].clear();
        listed.set(i, rods[i]);
        const double box = this->box, half = this->half;
        const Rod one = listed[i];
#pragma omp simd
        for (std::size_t j = 0; j < listed.size(); ++j)
            squared_distances[j] = squared_distance(box, half, one, listed[j]);
        for (int j = 0; j < int(listed.size()); ++j) {
            if (j == i || squared_distances[j] > (1 + skin) * (1 + skin)) continue;
            neighbours[i].push_back(j);
            neighbours[j].push_back(i);
        }
    }

    // Calls visit(compression) for every pair of neighbours: places shrunk by 1 - compression let the two touch.
    // Newton's method: their distance falls by r.n for each unit of compression, n from one to the other. Pairs that
    // stay apart in all bins need not be found to the digit.
    template <class Visit>
    void for_pairs(Visit visit) const {
        for (int i = 0; i < int(rods.size()); ++i)
            for (int j : neighbours[i]) {
                if (j > i) continue;
                const Vector r = nearest_image(box, rods[i], rods[j]);
                double compression = 0;
                for (int round = 0; round < 20 && compression < 2 * bins * bin_width; ++round) {
                    const Vector between = shortest(half, (1 - compression) * r, rods[i].direction, rods[j].direction);
                    const double distance = length(between), change = (distance - 1) * distance / dot(r, between);
                    compression += change;
                    if (std::abs(change) < 1e-12) break;
                }
                visit(compression);
            }
    }

    Vector in_ball() {
        for (;;) {
            const Vector v{2 * uniform(random) - 1, 2 * uniform(random) - 1, 2 * uniform(random) - 1};
            if (dot(v, v) <= 1) return v;
        }
    }

    double half, box;
    Rods rods, listed;
    std::vector<double> squared_distances;
    std::vector<std::vector<int>> neighbours;
    std::array<double, 3> steps{0.1, 0.2, 0.1};
    std::array<long, 3> tried{}, accepted{};
    std::mt19937_64 random;
    std::uniform_real_distribution<double> uniform;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return std::cerr << "usage: monte_carlo LENGTH COUNT SEED < states\n", 2;
    Simulation rods(std::atof(argv[1]), std::atoi(argv[2]), std::strtoull(argv[3], nullptr, 10));
    std::string line;
    while (std::getline(std::cin, line)) {
        double fraction = 0;
        long equilibration = 0, production = 0;
        std::string file;
        std::istringstream(line) >> fraction >> equilibration >> production >> file;
        rods.bring_to(fraction);
        for (long done = 0; done < equilibration; ++done) {
            rods.sweep();
            if (done % 100 == 99 && done < equilibration / 2) rods.adapt();
        }
        for (long done = 1; done <= production; ++done) {
            rods.sweep();
            if (done % sweeps_apart != 0) continue;
            std::printf("%g %.6f", fraction, rods.order());
            for (long count : rods.touching()) std::printf(" %ld", count);
            std::printf("\n");
        }
        std::fflush(stdout);
        if (!file.empty()) rods.write(file);
    }
}
