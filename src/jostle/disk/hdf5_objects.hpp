#pragma once

#include <hdf5.h>

#include <cstdlib>
#include <string>
#include <utility>

namespace jostle {

/// A call into HDF5 that failed; whoever knows the file turns it into a DiskError or an InputError.
struct Hdf5Failure {
    std::string operation;  ///< what was tried, a clause after "cannot"
    std::string reason;     ///< the innermost message of HDF5's error stack
    int error_number = 0;   ///< errno if the stack tells one

    bool is_out_of_memory() const { return reason.starts_with("memory allocation failed"); }
};

/// Keeps HDF5 from printing its error stack while it lives, and from complaining when the program ends.
class QuietHdf5 {
public:
    QuietHdf5() {
        // What a full disk or a damaged file leaves open inside HDF5 cannot be closed at the end of the program either;
        // the library would then complain on the terminal. Sound files have all been closed by then.
        H5dont_atexit();
        H5Eget_auto2(H5E_DEFAULT, &function_, &argument_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    QuietHdf5(const QuietHdf5&) = delete;
    QuietHdf5& operator=(const QuietHdf5&) = delete;
    ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, argument_); }

private:
    H5E_auto2_t function_ = nullptr;
    void* argument_ = nullptr;
};

/// Throws what HDF5's error stack tells about the call that just failed.
[[noreturn]] inline void throw_hdf5_failure(const char* operation) {
    Hdf5Failure failure{operation, "", 0};
    const auto look = [](unsigned, const H5E_error2_t* entry, void* target) -> herr_t {
        auto& found = *static_cast<Hdf5Failure*>(target);
        if (!entry->desc) return 0;
        if (found.reason.empty()) found.reason = entry->desc;
        const std::string text = entry->desc;
        const std::string mark = "errno = ";
        const std::size_t position = text.find(mark);
        if (position != std::string::npos) found.error_number = std::atoi(text.c_str() + position + mark.size());
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look, &failure);
    throw failure;
}

/// Passes on the result of an HDF5 call; negative results throw Hdf5Failure.
template <class Result>
Result hdf5_checked(Result result, const char* operation) {
    if (result < 0) throw_hdf5_failure(operation);
    return result;
}

/// Owns one HDF5 identifier of any kind.
class Hdf5Id {
public:
    Hdf5Id(hid_t id, const char* operation) : id_(hdf5_checked(id, operation)) {}
    Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
    Hdf5Id& operator=(Hdf5Id&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Hdf5Id() {
        if (id_ >= 0) H5Idec_ref(id_);
    }

    operator hid_t() const { return id_; }

    /// Closes it now, so that an error is seen: for a file this is when the last bytes are written.
    void close(const char* operation) { hdf5_checked(H5Idec_ref(std::exchange(id_, H5I_INVALID_HID)), operation); }

private:
    hid_t id_;
};

}  // namespace jostle
