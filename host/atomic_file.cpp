#include "host/atomic_file.h"

#include "host/errors.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace clucida::host {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what, const std::string& name)
{
    throw Failure(fmt::format("{} {}: {}", what, name, std::strerror(errno)));
}

/// An open file descriptor.
class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return fd_; }
    bool close()
    {
        const int fd = std::exchange(fd_, -1);
        return fd < 0 || ::close(fd) == 0;
    }

private:
    int fd_;
};

/// A file that is removed unless it is kept.
class Temporary {
public:
    explicit Temporary(std::string path) : path_(std::move(path)) {}
    ~Temporary()
    {
        if (!path_.empty()) ::unlink(path_.c_str());
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    void keep() { path_.clear(); }

private:
    std::string path_;
};

fs::path folder_of(const fs::path& file)
{
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Where a name leads to: a symbolic link keeps its place, its target is replaced.
fs::path target_of(const fs::path& file)
{
    std::error_code error;
    if (!fs::is_symlink(file, error)) return file;
    const fs::path target = fs::weakly_canonical(file, error);
    return error ? file : target;
}

bool is_special(const fs::path& file)
{
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    return !error && fs::exists(status) && !fs::is_regular_file(status);
}

mode_t usual_mode()
{
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

void write_special(const fs::path& file, std::string_view bytes)
{
    Descriptor out(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
    if (out.get() < 0) fail("cannot write", file.string());
    write_all(out.get(), bytes, file.string());
    if (!out.close()) fail("cannot write", file.string());
}

} // namespace

void require_writable(const fs::path& file)
{
    std::error_code error;
    if (fs::is_directory(file, error)) throw Failure(fmt::format("cannot write {}: it is a folder", file.string()));
    const fs::path target = target_of(file);
    if (is_special(target)) {
        if (::access(target.c_str(), W_OK) != 0) fail("cannot write", file.string());
        return;
    }
    const fs::path folder = folder_of(target);
    if (!fs::is_directory(folder, error))
        throw Failure(fmt::format("cannot write {}: there is no folder {}", file.string(), folder.string()));
    if (::access(folder.c_str(), W_OK | X_OK) != 0) fail("cannot write into the folder of", file.string());
}

void write_file(const fs::path& file, std::string_view bytes)
{
    const fs::path target = target_of(file);
    if (is_special(target)) return write_special(target, bytes);

    std::string name = (folder_of(target) / fmt::format(".{}.XXXXXX", target.filename().string())).string();
    Descriptor out(::mkstemp(name.data()));
    if (out.get() < 0) fail("cannot write", file.string());
    Temporary temporary(name);
    write_all(out.get(), bytes, file.string());
    if (::fchmod(out.get(), usual_mode()) != 0 || ::fsync(out.get()) != 0 || !out.close())
        fail("cannot write", file.string());
    if (::rename(name.c_str(), target.c_str()) != 0) fail("cannot write", file.string());
    temporary.keep();
}

void write_all(int descriptor, std::string_view bytes, const std::string& name)
{
    while (!bytes.empty()) {
        const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
        if (n >= 0)
            bytes.remove_prefix(static_cast<std::size_t>(n));
        else if (errno != EINTR)
            fail("cannot write", name);
    }
}

std::string read_file(const fs::path& file)
{
    Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    if (in.get() < 0) fail("cannot read", file.string());
    std::string out;
    for (std::string piece(std::size_t{1} << 16, '\0');;) {
        const ssize_t n = ::read(in.get(), piece.data(), piece.size());
        if (n == 0) return out;
        if (n > 0)
            out.append(piece, 0, static_cast<std::size_t>(n));
        else if (errno != EINTR)
            fail("cannot read", file.string());
    }
}

} // namespace clucida::host
