#include "host/kernel_source.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <stdexcept>

extern const char* const clucida_kernels_table[]; // made by kernels/embed.cmake

namespace clucida::host {
namespace {

std::string_view trim(std::string_view s)
{
    const auto begin = s.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return s.substr(begin, s.find_last_not_of(" \t\r") - begin + 1);
}

/// The directive of a line ("ifdef", "include", ...) and what follows it; empty if the line is none.
struct Directive {
    std::string_view name, rest;
};
Directive directive_of(std::string_view line)
{
    line = trim(line);
    if (line.empty() || line.front() != '#') return {};
    line = trim(line.substr(1));
    const auto end = std::min(line.find_first_of(" \t\"<"), line.size());
    return {line.substr(0, end), trim(line.substr(end))};
}

/// Follows conditional blocks only as far as to know whether a line stands where OpenCL compilers never look.
class HostOnlyBlocks {
public:
    void see(const Directive& d)
    {
        if (d.name == "if" || d.name == "ifdef" || d.name == "ifndef") {
            const bool asks = d.rest.substr(0, d.rest.find_first_of(" \t/")) == "__OPENCL_VERSION__";
            blocks_.push_back(!asks || d.name == "if" ? Block::unknown
                              : d.name == "ifdef"     ? Block::device
                                                      : Block::host);
        } else if (blocks_.empty()) {
            return;
        } else if (d.name == "endif") {
            blocks_.pop_back();
        } else if (d.name == "else") {
            Block& b = blocks_.back();
            b = b == Block::device ? Block::host : b == Block::host ? Block::device : Block::unknown;
        } else if (d.name == "elif") {
            blocks_.back() = Block::unknown;
        }
    }
    bool inside() const
    {
        for (const Block b : blocks_)
            if (b == Block::host) return true;
        return false;
    }

private:
    enum class Block { unknown, device, host };
    std::vector<Block> blocks_;
};

class Resolver {
public:
    explicit Resolver(const FileTexts& files) : files_(files) {}

    void add(const std::string& path, std::string_view text)
    {
        seen_.insert(path);
        out_ += fmt::format("#line 1 \"{}\"\n", path);
        HostOnlyBlocks blocks;
        for (std::size_t number = 1; !text.empty(); ++number) {
            const auto end = std::min(text.find('\n'), text.size());
            const std::string_view line = text.substr(0, end);
            text.remove_prefix(std::min(end + 1, text.size()));
            const Directive d = directive_of(line);
            blocks.see(d);
            if (d.name == "include" && !blocks.inside() && include(path, d.rest)) {
                out_ += fmt::format("#line {} \"{}\"\n", number + 1, path);
            } else {
                out_ += line;
                out_ += '\n';
            }
        }
    }
    std::string take() { return std::move(out_); }

private:
    bool include(const std::string& from, std::string_view quoted)
    {
        if (quoted.size() < 2 || quoted.front() != '"') return false;
        const std::string name(quoted.substr(1, quoted.find('"', 1) - 1));
        const std::string beside =
            (std::filesystem::path(from).parent_path() / name).lexically_normal().generic_string();
        for (const std::string& path : {name, beside}) {
            const auto text = files_(path);
            if (!text) continue;
            if (!seen_.count(path)) add(path, *text);
            return true;
        }
        return false;
    }

    const FileTexts& files_;
    std::set<std::string> seen_;
    std::string out_;
};

} // namespace

std::optional<std::string_view> embedded_kernel(const std::string& path)
{
    for (const char* const* entry = clucida_kernels_table; *entry; entry += 2)
        if (path == entry[0]) return entry[1];
    return std::nullopt;
}

std::vector<std::string> embedded_kernel_paths()
{
    std::vector<std::string> out;
    for (const char* const* entry = clucida_kernels_table; *entry; entry += 2) out.emplace_back(entry[0]);
    return out;
}

std::string resolve_includes(const std::string& entry, const FileTexts& files)
{
    const auto text = files(entry);
    if (!text) throw std::runtime_error(fmt::format("there is no kernel file {}", entry));
    Resolver resolver(files);
    resolver.add(entry, *text);
    return resolver.take();
}

std::string kernel_source(const std::string& entry)
{
    return resolve_includes(entry, embedded_kernel);
}

} // namespace clucida::host
