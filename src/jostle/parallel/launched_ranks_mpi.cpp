// Ranks that are processes, joined by MPI: the only source that names it.

#include <mpi.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/launched_ranks.hpp"

namespace jostle {

namespace {

using Bytes = RankLink::Bytes;

/// MPI counts in int: what is longer goes in pieces.
constexpr std::size_t longest_message = std::size_t{1} << 30;
/// Messages of `deal` and of an `Exchange` are told apart.
enum Tag : int { tag_of_deal, tag_of_exchange };

/// Calls use(place, bytes) for each piece, in their order.
template <class Byte, class Use>
void for_each_piece(std::span<Byte> message, Use&& use) {
    for (std::size_t begin = 0; begin < message.size(); begin += longest_message) {
        const std::size_t bytes = std::min(longest_message, message.size() - begin);
        use(message.data() + begin, static_cast<int>(bytes));
    }
}

MPI_Request& one_more(std::vector<MPI_Request>& requests) {
    return requests.emplace_back(MPI_REQUEST_NULL);
}

void wait_for_all(std::vector<MPI_Request>& requests) {
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

/// Persistent requests: what has to be agreed upon about a message is agreed upon once.
class MpiExchange final : public Exchange {
public:
    explicit MpiExchange(std::vector<Peer> peers) : Exchange(std::move(peers)) {
        for (std::size_t k = 0; k < peers_.size(); ++k)
            for_each_piece(std::span(in_[k]), [&](std::byte* place, int bytes) {
                MPI_Recv_init(place, bytes, MPI_BYTE, peers_[k].rank, tag_of_exchange, MPI_COMM_WORLD,
                              &one_more(requests_));
            });
        for (std::size_t k = 0; k < peers_.size(); ++k)
            for_each_piece(std::span(out_[k]), [&](std::byte* place, int bytes) {
                MPI_Send_init(place, bytes, MPI_BYTE, peers_[k].rank, tag_of_exchange, MPI_COMM_WORLD,
                              &one_more(requests_));
            });
    }
    ~MpiExchange() override {
        for (MPI_Request& request : requests_) MPI_Request_free(&request);
    }

    void begin() override {
        if (!requests_.empty()) MPI_Startall(static_cast<int>(requests_.size()), requests_.data());  // none is an error
    }
    void wait() override { wait_for_all(requests_); }

private:
    std::vector<MPI_Request> requests_;
};

/// Does something with a file. MPI tells by its code what is wrong, or no more than that something is: then errno,
/// which the system has left, does.
template <class Act>
void on_file(Act&& act) {
    errno = 0;
    const int code = act();
    if (code == MPI_SUCCESS) return;
    int error_number = errno != 0 ? errno : EIO;
    int kind = MPI_ERR_OTHER;
    MPI_Error_class(code, &kind);
    if (kind == MPI_ERR_NO_SPACE) error_number = ENOSPC;
    if (kind == MPI_ERR_QUOTA) error_number = EDQUOT;
    if (kind == MPI_ERR_ACCESS) error_number = EACCES;
    if (kind == MPI_ERR_NO_SUCH_FILE) error_number = ENOENT;
    throw std::system_error(error_number, std::generic_category());
}

class MpiFile final : public FileOfRanks {
public:
    explicit MpiFile(const std::string& path) {
        on_file([&] { return MPI_File_open(MPI_COMM_WORLD, path.c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file_); });
    }

    void write_at(std::uint64_t place, std::string_view bytes) override {
        for_each_piece(std::span(bytes), [&](const char* begin, int size) {
            MPI_Status status;
            on_file([&] {
                return MPI_File_write_at(file_, static_cast<MPI_Offset>(place), begin, size, MPI_BYTE, &status);
            });
            int written = 0;
            MPI_Get_count(&status, MPI_BYTE, &written);
            if (written != size) throw std::system_error(ENOSPC, std::generic_category());
            place += static_cast<std::uint64_t>(size);
        });
    }
    void finish() override {
        on_file([&] { return MPI_File_sync(file_); });
        on_file([&] { return MPI_File_close(&file_); });
    }

private:
    MPI_File file_ = MPI_FILE_NULL;
};

class MpiLink final : public RankLink {
public:
    MpiLink() {
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &count_);
    }

    int rank() const override { return rank_; }
    int count() const override { return count_; }

    void largest(std::span<double> values) override {
        MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX,
                      MPI_COMM_WORLD);
    }
    void add_up(std::span<std::int64_t> numbers) override {
        MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_INT64_T, MPI_SUM,
                      MPI_COMM_WORLD);
    }

    std::vector<Bytes> deal(const std::vector<Bytes>& to) override {
        std::vector<std::int64_t> sent(to.size()), arriving(to.size());
        for (std::size_t q = 0; q < to.size(); ++q) sent[q] = static_cast<std::int64_t>(to[q].size());
        MPI_Alltoall(sent.data(), 1, MPI_INT64_T, arriving.data(), 1, MPI_INT64_T, MPI_COMM_WORLD);
        std::vector<Bytes> from(to.size());
        std::vector<MPI_Request> requests;
        const auto here = static_cast<std::size_t>(rank_);
        for (std::size_t p = 0; p < to.size(); ++p) {
            if (p == here) continue;
            from[p].resize(static_cast<std::size_t>(arriving[p]));
            for_each_piece(std::span(from[p]), [&](std::byte* place, int bytes) {
                MPI_Irecv(place, bytes, MPI_BYTE, static_cast<int>(p), tag_of_deal, MPI_COMM_WORLD,
                          &one_more(requests));
            });
        }
        for (std::size_t q = 0; q < to.size(); ++q) {
            if (q == here) continue;
            for_each_piece(std::span(to[q]), [&](const std::byte* place, int bytes) {
                MPI_Isend(place, bytes, MPI_BYTE, static_cast<int>(q), tag_of_deal, MPI_COMM_WORLD,
                          &one_more(requests));
            });
        }
        from[here] = to[here];
        wait_for_all(requests);
        return from;
    }

    Bytes of_first(Bytes message) override {
        auto bytes = static_cast<std::int64_t>(message.size());
        MPI_Bcast(&bytes, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
        message.resize(static_cast<std::size_t>(bytes));
        for_each_piece(std::span(message),
                       [](std::byte* place, int piece) { MPI_Bcast(place, piece, MPI_BYTE, 0, MPI_COMM_WORLD); });
        return message;
    }

    std::unique_ptr<Exchange> exchange(std::vector<Exchange::Peer> peers) override {
        return std::make_unique<MpiExchange>(std::move(peers));
    }
    std::unique_ptr<FileOfRanks> open(const std::string& path) override { return std::make_unique<MpiFile>(path); }

private:
    int rank_ = 0, count_ = 1;
};

}  // namespace

bool LaunchedRanks::are_built_in() {
    return true;
}

LaunchedRanks::LaunchedRanks() {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    link_ = std::make_unique<MpiLink>();
    const int started = launch_in_environment().count;
    if (link_->count() == started) return;
    throw InputError({.key = "ranks",
                      .value = std::to_string(started),
                      .problem = "so many processes were started, and MPI joins " + std::to_string(link_->count()),
                      .suggestion = "Start them by the mpirun of the MPI that jostle was built with, or by srun "
                                    "--mpi=pmix"});
}

LaunchedRanks::~LaunchedRanks() {
    MPI_Finalize();
}

Ranks LaunchedRanks::ranks() const {
    return Ranks(*link_);
}

int LaunchedRanks::on_this_machine() const {
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    int count = 1;
    MPI_Comm_size(machine, &count);
    MPI_Comm_free(&machine);
    return count;
}

void LaunchedRanks::give_up(int exit_code) const {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::abort();  // MPI_Abort does not return
}

}  // namespace jostle
