/// A folder of its own for what is needed for a while.
#pragma once

#include "host/errors.h"

#include <stdlib.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace clucida::bench {

/// Goes with all that lies in it when it is no longer held.
class TemporaryFolder {
public:
    /// @throws host::Failure
    TemporaryFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "clucida-bench-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw host::Failure("cannot make a temporary folder " + name);
        path_ = name;
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace clucida::bench
