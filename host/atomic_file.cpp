#include "host/atomic_file.h"

#include "host/errors.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
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

/// A file without a name, for what may be copied to its place only when it is whole.
int open_nameless()
{
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "clucida.XXXXXX").string();
    const int fd = error ? -1 : ::mkostemp(name.data(), O_CLOEXEC);
    if (fd < 0) return ::memfd_create("clucida", MFD_CLOEXEC);
    ::unlink(name.c_str());
    return fd;
}

/// Copies the whole of one file to another.
void copy_all(int from, int to, const std::string& name)
{
    std::string piece(std::size_t{1} << 18, '\0');
    for (off_t at = 0;;) {
        const ssize_t n = ::pread(from, piece.data(), piece.size(), at);
        if (n == 0) return;
        if (n > 0) {
            write_all(to, std::string_view(piece).substr(0, static_cast<std::size_t>(n)), name);
            at += n;
        } else if (errno != EINTR) {
            fail("cannot read what was written for", name);
        }
    }
}

bool is_output(const fs::path& file)
{
    return file == "-";
}

} // namespace

struct PendingFile::State {
    fs::path file;       ///< as it was named
    fs::path target;     ///< where that leads to
    bool copied = false; ///< at the end, for the target is no file that could be renamed to
    std::string name;    ///< of the temporary file, if it has one
    Descriptor out;
    Temporary temporary;

    explicit State(const fs::path& file_)
        : file(file_), target(target_of(file)), copied(is_output(file) || is_special(target)),
          name(copied ? "" : (folder_of(target) / fmt::format(".{}.XXXXXX", target.filename().string())).string()),
          out(copied ? open_nameless() : ::mkostemp(name.data(), O_CLOEXEC)), temporary(out.get() < 0 ? "" : name)
    {
    }
};

PendingFile::PendingFile(const fs::path& file) : state_(std::make_unique<State>(file))
{
    if (state_->out.get() < 0) fail("cannot write", file.string());
    ::flock(state_->out.get(), LOCK_EX | LOCK_NB); // what is not locked is a leftover; where files cannot be, none is
}

PendingFile::~PendingFile() = default;

void PendingFile::write(std::uint64_t offset, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t n = ::pwrite(state_->out.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (n >= 0) {
            bytes.remove_prefix(static_cast<std::size_t>(n));
            offset += static_cast<std::size_t>(n);
        } else if (errno != EINTR) {
            fail("cannot write", state_->file.string());
        }
    }
}

const std::string& PendingFile::temporary_name() const
{
    if (state_->copied)
        throw Failure(fmt::format("cannot write {}: another program writes it, and that needs a regular file",
                                  state_->file.string()));
    return state_->name;
}

void PendingFile::commit()
{
    State& s = *state_;
    if (is_output(s.file)) return copy_all(s.out.get(), STDOUT_FILENO, "standard output");
    if (s.copied) {
        Descriptor to(::open(s.target.c_str(), O_WRONLY | O_CLOEXEC));
        if (to.get() < 0) fail("cannot write", s.file.string());
        copy_all(s.out.get(), to.get(), s.file.string());
        if (!to.close()) fail("cannot write", s.file.string());
        return;
    }
    // Renamed before it is closed, for until then it counts as in use.
    if (::fchmod(s.out.get(), usual_mode()) != 0 || ::fsync(s.out.get()) != 0 ||
        ::rename(s.name.c_str(), s.target.c_str()) != 0)
        fail("cannot write", s.file.string());
    s.temporary.keep();
    if (!s.out.close()) fail("cannot write", s.file.string());
}

void remove_leftovers(const std::vector<fs::path>& files)
{
    constexpr std::size_t random_letters = 6; // of mkostemp's names
    std::map<fs::path, std::set<std::string>> names;
    for (const fs::path& file : files)
        names[folder_of(target_of(file))].insert(fmt::format(".{}", target_of(file).filename().string()));
    for (const auto& [folder, known] : names) {
        std::error_code error;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
            const std::string name = entry.path().filename().string();
            if (name.size() <= random_letters + 1 || name[name.size() - random_letters - 1] != '.') continue;
            if (!known.contains(name.substr(0, name.size() - random_letters - 1))) continue;
            const Descriptor leftover(::open(entry.path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
            if (leftover.get() >= 0 && ::flock(leftover.get(), LOCK_EX | LOCK_NB) == 0) ::unlink(entry.path().c_str());
        }
    }
}

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
    PendingFile pending(file);
    pending.write(0, bytes);
    pending.commit();
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
