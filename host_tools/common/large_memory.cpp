// SPDX-License-Identifier: MIT
#include "common/large_memory.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include "common/errors.hpp"

namespace sdre {
namespace {

/// Not /tmp, which may be memory itself.
std::string place()
{
    const char *wanted = std::getenv("TMPDIR");
    return wanted != nullptr && *wanted != '\0' ? wanted : "/var/tmp";
}

class UnnamedFile {
public:
    explicit UnnamedFile(std::size_t bytes)
    {
        std::string name = place() + "/sdre-XXXXXX";
        fd_              = mkstemp(name.data());
        if (fd_ < 0) {
            fail(bytes, errno);
        }
        unlink(name.c_str());
        const int why = posix_fallocate(fd_, 0, static_cast<off_t>(bytes)); // all of it, or none
        if (why != 0) {
            close(fd_);
            fail(bytes, why);
        }
    }
    ~UnnamedFile()
    {
        close(fd_);
    }
    UnnamedFile(const UnnamedFile &)            = delete;
    UnnamedFile &operator=(const UnnamedFile &) = delete;

    void *mapped(std::size_t bytes) const
    {
        return mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0);
    }

private:
    [[noreturn]] static void fail(std::size_t bytes, int why)
    {
        throw InputError(fmt::format("{}: no room for {} MB of a long run (TMPDIR): {}", place(),
                                     bytes >> 20, std::strerror(why)));
    }

    int fd_ = -1;
};

} // namespace

void *large_memory_get(std::size_t bytes)
{
    if (bytes < large_memory_B) {
        return ::operator new(bytes);
    }
    void *memory = UnnamedFile(bytes).mapped(bytes); // it stays while it is mapped
    if (memory == MAP_FAILED) {
        throw std::bad_alloc();
    }
    return memory;
}

void large_memory_put(void *memory, std::size_t bytes)
{
    if (bytes < large_memory_B) {
        ::operator delete(memory);
    } else {
        munmap(memory, bytes);
    }
}

} // namespace sdre
