/// A file that appears whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clucida::host {

/// A file that grows under a temporary name until it is committed. In the target's folder; for standard output ("-")
/// and for what is no regular file (a device, a pipe), which can take nothing back, in the folder for temporary files
/// (TMPDIR, else /tmp) or, where that takes none, in memory. Not committed, it leaves nothing.
class PendingFile {
public:
    /// @throws Failure with the system's reason, like all its functions
    explicit PendingFile(const std::filesystem::path& file);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    void write(std::uint64_t offset, std::string_view bytes);
    /// For another program to write to instead. @throws Failure if there is none, for the target is no regular file
    const std::string& temporary_name() const;
    /// Flushes it to the disk and gives it its name; or copies it to where it is to go.
    void commit();

private:
    struct State; // keeps the system's headers out of this one
    std::unique_ptr<State> state_;
};

/// Removes temporary files beside these ones that no PendingFile is at: a process that was killed has left them.
void remove_leftovers(const std::vector<std::filesystem::path>& files);

/// Checks, before any work is done, that a file of this name could be written. @throws Failure saying why not
void require_writable(const std::filesystem::path& file);

/// Writes the file: a temporary name in the same folder, flushed to the disk, then renamed; on failure the temporary
/// file is removed. What exists and is no regular file (a device, a pipe) is written to directly.
/// @throws Failure with the system's reason
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Writes all bytes to a descriptor, such as standard output. name is for the error. @throws Failure
void write_all(int descriptor, std::string_view bytes, const std::string& name);

/// The whole file. @throws Failure with the system's reason
std::string read_file(const std::filesystem::path& file);

} // namespace clucida::host
