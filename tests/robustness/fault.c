// Preloaded before the C library (LD_PRELOAD): at the k-th call that changes a file the process dies, the call fails, or it is done by half.
//
//   JOSTLE_FAULT_AT=k        counted from 1; 0: none, only counted
//   JOSTLE_FAULT=KIND        kill: SIGKILL in place of the call; torn: half of a write, then SIGKILL; an error number such as 28 (ENOSPC):
//                            the call fails once; -28: it fails from then on; short: half of a write, which says so
//   JOSTLE_FAULT_LOG=FILE    every call is recorded there, for the reconstruction of power cuts: see power_cuts.py
//   JOSTLE_FAULT_COUNT=FILE  the number of calls at the end
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static long calls, fault_at;
static int count_descriptor = -1, log_descriptor = -1;
static const char* fault = "";

static void begin(void) __attribute__((constructor));
static void begin(void) {
    const char* at = getenv("JOSTLE_FAULT_AT");
    if (at) fault_at = atol(at);
    if (getenv("JOSTLE_FAULT")) fault = getenv("JOSTLE_FAULT");
    // Far from the numbers that the program gets, and by the kernel, for open() is ours.
    const char* names[2] = {getenv("JOSTLE_FAULT_COUNT"), getenv("JOSTLE_FAULT_LOG")};
    int* descriptors[2] = {&count_descriptor, &log_descriptor};
    for (int k = 0; k < 2; ++k) {
        if (!names[k]) continue;
        const long opened = syscall(SYS_openat, AT_FDCWD, names[k], O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
        *descriptors[k] = fcntl((int)opened, F_DUPFD_CLOEXEC, 900 + k);
        syscall(SYS_close, opened);
    }
}

static void end(void) __attribute__((destructor));
static void end(void) {
    if (count_descriptor >= 0) dprintf(count_descriptor, "%ld\n", calls);
}

// What a descriptor or a folder's descriptor stands for.
static void name_of(int descriptor, char* path, size_t room) {
    char link[64];
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, path, room - 1);
    path[length > 0 ? length : 0] = '\0';
}

static void full_name(int folder, const char* name, char* path, size_t room) {
    if (name[0] == '/' || folder == AT_FDCWD) {
        char here[4096] = "";
        if (name[0] != '/' && !getcwd(here, sizeof here)) here[0] = '\0';
        snprintf(path, room, "%s%s%s", here, here[0] ? "/" : "", name);
        return;
    }
    char of_folder[4096];
    name_of(folder, of_folder, sizeof of_folder);
    snprintf(path, room, "%s/%s", of_folder, name);
}

static int is_regular(int descriptor) {
    struct stat status;
    return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

// One record: "operation\0path\0other\0", then offset and length (two int64), then that many bytes.
static void record(const char* operation, const char* path, const char* other, int64_t offset, const void* bytes, int64_t length) {
    if (log_descriptor < 0) return;
    const size_t header = strlen(operation) + strlen(path) + strlen(other) + 3 + 16;
    char* whole = malloc(header + (size_t)length);
    char* at = whole;
    at = stpcpy(at, operation) + 1;
    at = stpcpy(at, path) + 1;
    at = stpcpy(at, other) + 1;
    memcpy(at, &offset, 8);
    memcpy(at + 8, &length, 8);
    if (length > 0) memcpy(at + 16, bytes, (size_t)length);
    if (syscall(SYS_write, log_descriptor, whole, header + (size_t)length) < 0) abort();
    free(whole);
}

// Whether this call is the one; an error number in errno if it shall fail. `half`: what to do first if it is to be torn.
enum Fate { goes_on, fails, by_half };
static enum Fate fate(void) {
    const long number = __atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST);
    const int error = atoi(fault);
    if (fault_at <= 0 || number < fault_at || (number > fault_at && error >= 0)) return goes_on;
    if (strcmp(fault, "kill") == 0) kill(getpid(), SIGKILL);
    if (strcmp(fault, "torn") == 0 || strcmp(fault, "short") == 0) return by_half;
    errno = abs(error);
    return error ? fails : goes_on;
}

static void die_if_torn(void) {
    if (strcmp(fault, "torn") == 0) kill(getpid(), SIGKILL);
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int descriptor, const void* bytes, size_t length) {
    if (!is_regular(descriptor)) return NEXT(write)(descriptor, bytes, length);
    const enum Fate what = fate();
    if (what == fails) return -1;
    if (what == by_half) length /= 2;
    const ssize_t done = what == by_half && length == 0 ? 0 : NEXT(write)(descriptor, bytes, length);
    if (what == by_half) die_if_torn();
    char path[4096];
    name_of(descriptor, path, sizeof path);
    if (done > 0) record("write", path, "", lseek(descriptor, 0, SEEK_CUR) - done, bytes, done);
    return done;
}

static ssize_t write_at(ssize_t (*next)(int, const void*, size_t, off64_t), int descriptor, const void* bytes, size_t length, off64_t offset) {
    const enum Fate what = fate();
    if (what == fails) return -1;
    if (what == by_half) length /= 2;
    const ssize_t done = next(descriptor, bytes, length, offset);
    if (what == by_half) die_if_torn();
    char path[4096];
    name_of(descriptor, path, sizeof path);
    if (done > 0) record("write", path, "", offset, bytes, done);
    return done;
}
ssize_t pwrite(int descriptor, const void* bytes, size_t length, off_t offset) {
    return write_at((ssize_t(*)(int, const void*, size_t, off64_t))dlsym(RTLD_NEXT, "pwrite"), descriptor, bytes, length, offset);
}
ssize_t pwrite64(int descriptor, const void* bytes, size_t length, off64_t offset) {
    return write_at((ssize_t(*)(int, const void*, size_t, off64_t))dlsym(RTLD_NEXT, "pwrite64"), descriptor, bytes, length, offset);
}

static int opened(int folder, const char* name, int flags, mode_t mode) {
    const int changes = flags & (O_CREAT | O_TRUNC);
    if (changes && fate() == fails) return -1;
    char path[4096];
    full_name(folder, name, path, sizeof path);
    struct stat status;
    const int is_new = (flags & O_CREAT) && fstatat(folder, name, &status, 0) != 0;
    const int descriptor = (int)syscall(SYS_openat, folder, name, flags, mode);
    if (descriptor < 0) return -1;
    if (is_new) record("create", path, "", 0, NULL, 0);
    if (!is_new && (flags & O_TRUNC)) record("truncate", path, "", 0, NULL, 0);
    return descriptor;
}
#define MODE_OF(flags, mode)                                       \
    mode_t mode = 0;                                               \
    if ((flags) & (O_CREAT | __O_TMPFILE)) {                       \
        va_list rest;                                              \
        va_start(rest, flags);                                     \
        mode = va_arg(rest, mode_t);                               \
        va_end(rest);                                              \
    }
int open(const char* name, int flags, ...) {
    MODE_OF(flags, mode)
    return opened(AT_FDCWD, name, flags, mode);
}
int open64(const char* name, int flags, ...) {
    MODE_OF(flags, mode)
    return opened(AT_FDCWD, name, flags, mode);
}
int openat(int folder, const char* name, int flags, ...) {
    MODE_OF(flags, mode)
    return opened(folder, name, flags, mode);
}
int openat64(int folder, const char* name, int flags, ...) {
    MODE_OF(flags, mode)
    return opened(folder, name, flags, mode);
}

static int renamed(int from_folder, const char* from, int to_folder, const char* to) {
    if (fate() == fails) return -1;
    char before[4096], after[4096];
    full_name(from_folder, from, before, sizeof before);
    full_name(to_folder, to, after, sizeof after);
    const int status = (int)syscall(SYS_renameat2, from_folder, from, to_folder, to, 0);
    if (status == 0) record("rename", before, after, 0, NULL, 0);
    return status;
}
int rename(const char* from, const char* to) { return renamed(AT_FDCWD, from, AT_FDCWD, to); }
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
    return renamed(from_folder, from, to_folder, to);
}

static int unlinked(int folder, const char* name, int flags) {
    if (fate() == fails) return -1;
    char path[4096];
    full_name(folder, name, path, sizeof path);
    const int status = (int)syscall(SYS_unlinkat, folder, name, flags);
    if (status == 0) record("unlink", path, "", 0, NULL, 0);
    return status;
}
int unlink(const char* name) { return unlinked(AT_FDCWD, name, 0); }
int unlinkat(int folder, const char* name, int flags) { return unlinked(folder, name, flags); }

int mkdir(const char* name, mode_t mode) {
    if (fate() == fails) return -1;
    char path[4096];
    full_name(AT_FDCWD, name, path, sizeof path);
    const int status = (int)syscall(SYS_mkdirat, AT_FDCWD, name, mode);
    if (status == 0) record("mkdir", path, "", 0, NULL, 0);
    return status;
}

static int shortened(int descriptor, off64_t length) {
    if (fate() == fails) return -1;
    const int status = (int)syscall(SYS_ftruncate, descriptor, length);
    char path[4096];
    name_of(descriptor, path, sizeof path);
    if (status == 0) record("truncate", path, "", length, NULL, 0);
    return status;
}
int ftruncate(int descriptor, off_t length) { return shortened(descriptor, length); }
int ftruncate64(int descriptor, off64_t length) { return shortened(descriptor, length); }

static int synced(int descriptor, long number) {
    if (fate() == fails) return -1;
    const int status = (int)syscall(number, descriptor);
    char path[4096];
    name_of(descriptor, path, sizeof path);
    if (status == 0) record("sync", path, "", 0, NULL, 0);
    return status;
}
int fsync(int descriptor) { return synced(descriptor, SYS_fsync); }
int fdatasync(int descriptor) { return synced(descriptor, SYS_fdatasync); }
