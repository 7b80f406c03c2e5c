// SPDX-License-Identifier: MIT
#include "common/file_output.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/errors.hpp"

namespace sdre {
namespace {

namespace fs = std::filesystem;

constexpr mode_t new_file   = 0666; // less the user's umask
constexpr int    most_links = 40;   // as many as the kernel follows

[[noreturn]] void fail(const OutputFile &file, const std::string &why)
{
    throw InputError(fmt::format("{}: cannot write: {}", file.path.string(), why));
}

template <typename Write> void for_all_pieces(const OutputFile &file, const Write &write)
{
    write(file.text);
    while (file.more) {
        const std::string piece = file.more();
        if (piece.empty()) {
            return;
        }
        write(piece);
    }
}

/// An open file; every failure names the path that the user gave.
class Descriptor {
public:
    Descriptor(const OutputFile &file, const fs::path &path, int flags)
        : file_(file), fd_(open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, new_file))
    {
    }
    ~Descriptor()
    {
        if (fd_ >= 0) {
            close(fd_);
        }
    }
    Descriptor(const Descriptor &)            = delete;
    Descriptor &operator=(const Descriptor &) = delete;

    bool is_open() const
    {
        return fd_ >= 0;
    }
    void set_mode(mode_t mode)
    {
        if (fchmod(fd_, mode) != 0) {
            fail(file_, std::strerror(errno));
        }
    }
    void write_all()
    {
        for_all_pieces(file_, [this](const std::string &piece) { write_piece(piece); });
        const int fd = fd_;
        fd_          = -1;
        if (close(fd) != 0) { // network disks are full only now
            fail(file_, std::strerror(errno));
        }
    }

private:
    void write_piece(const std::string &piece)
    {
        for (std::size_t at = 0; at < piece.size();) {
            const ssize_t n = write(fd_, piece.data() + at, piece.size() - at);
            if (n < 0 && errno != EINTR) {
                fail(file_, std::strerror(errno));
            }
            at += n > 0 ? static_cast<std::size_t>(n) : 0;
        }
    }

    const OutputFile &file_;
    int               fd_;
};

/// One file on its way: where it ends up, and under which name it waits.
struct Target {
    const OutputFile *file;
    fs::path          path; ///< behind all links
    fs::path          waiting;
    mode_t            mode      = 0; ///< of the file that was there; 0: none was
    bool              direct    = false;
    bool              is_stdout = false; ///< under another name: what is printed goes behind it
};

/// The path behind a link, also when nothing is there yet.
fs::path behind_links(const OutputFile &file)
{
    fs::path        path = file.path;
    std::error_code error;
    for (int i = 0; i < most_links && fs::is_symlink(path, error); i++) {
        path = path.parent_path() / fs::read_symlink(path, error);
    }
    return path;
}

Target target_of(const OutputFile &file)
{
    Target      target{&file, behind_links(file), {}};
    struct stat at {};
    if (stat(file.path.c_str(), &at) != 0) {
        return target; // a new file, or a missing directory: opening reports it
    }
    if (S_ISDIR(at.st_mode)) { // rename would fail after earlier ones worked
        fail(file, "is a directory");
    }
    struct stat out {};
    target.is_stdout =
        fstat(STDOUT_FILENO, &out) == 0 && at.st_dev == out.st_dev && at.st_ino == out.st_ino;
    target.mode   = at.st_mode & 07777;
    target.direct = !S_ISREG(at.st_mode) || target.is_stdout;
    return target;
}

/// Creates the file under a unique name: two tools may write to one directory at once.
void write_waiting(Target &target)
{
    for (int n = 0;; n++) {
        target.waiting = target.path.parent_path() / fmt::format(".sdre-{}-{}.tmp", getpid(), n);
        Descriptor out(*target.file, target.waiting, O_CREAT | O_EXCL);
        if (!out.is_open()) {
            const int why = errno;
            target.waiting.clear();
            if (why == EEXIST) {
                continue;
            }
            fail(*target.file, std::strerror(why));
        }
        if (target.mode != 0) {
            out.set_mode(target.mode);
        }
        out.write_all();
        return;
    }
}

void write_direct(const Target &target)
{
    if (target.is_stdout) {
        for_all_pieces(*target.file, [&](const std::string &piece) {
            if (std::fwrite(piece.data(), 1, piece.size(), stdout) != piece.size() ||
                std::fflush(stdout) != 0) {
                fail(*target.file, std::strerror(errno));
            }
        });
        return;
    }
    Descriptor out(*target.file, target.file->path, O_APPEND);
    if (!out.is_open()) {
        fail(*target.file, std::strerror(errno));
    }
    out.write_all();
}

void put_in_place(Target &target)
{
    std::error_code error;
    fs::rename(target.waiting, target.path, error);
    if (error) {
        fail(*target.file, error.message());
    }
    target.waiting.clear();
}

/// Removes the remaining temporary files in any case.
struct Targets {
    std::vector<Target> all;

    Targets()                           = default;
    Targets(const Targets &)            = delete;
    Targets &operator=(const Targets &) = delete;
    ~Targets()
    {
        std::error_code ignored;
        for (const Target &target : all) {
            if (!target.waiting.empty()) {
                fs::remove(target.waiting, ignored);
            }
        }
    }
};

} // namespace

void write_files(const std::vector<OutputFile> &files)
{
    Targets            targets;
    std::set<fs::path> seen;
    for (const OutputFile &file : files) {
        targets.all.push_back(target_of(file));
        const Target &target = targets.all.back();
        if (!target.direct && !seen.insert(fs::absolute(target.path).lexically_normal()).second) {
            fail(file, "is given twice");
        }
    }
    for (Target &target : targets.all) {
        if (!target.direct) {
            write_waiting(target);
        }
    }
    for (const Target &target : targets.all) {
        if (target.direct) {
            write_direct(target);
        }
    }
    for (Target &target : targets.all) {
        if (!target.direct) {
            put_in_place(target);
        }
    }
}

std::string read_text_file(const fs::path &file)
{
    std::error_code error;
    if (!fs::is_regular_file(file, error)) { // a directory opens, and reads as empty
        throw InputError(fmt::format("{}: cannot read", file.string()));
    }
    std::ifstream      stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) {
        throw InputError(fmt::format("{}: cannot read", file.string()));
    }
    return text.str();
}

} // namespace sdre
