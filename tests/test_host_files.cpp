#include "host/atomic_file.h"
#include "host/errors.h"
#include "host/program_cache.h"
#include "host/sha256.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

namespace clucida::host {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own.
class Files : public testing::Test {
protected:
    void SetUp() override
    {
        std::string name = (fs::temp_directory_path() / "clucida_test_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder = name;
    }
    void TearDown() override { fs::remove_all(folder); }
    std::size_t count() const
    {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }
    fs::path folder;
};

TEST_F(Files, leftovers_of_those_that_were_killed_are_removed_and_what_is_in_use_is_not)
{
    write_file(folder / ".a.abcdef", "left");
    write_file(folder / ".a.abcdefg", "another thing");
    write_file(folder / ".b.abcdef", "of another file");
    PendingFile pending(folder / "a");
    pending.write(0, "half");
    ASSERT_EQ(count(), 4U);
    remove_leftovers({folder / "a", folder / "none"});
    EXPECT_EQ(count(), 3U);
    EXPECT_FALSE(fs::exists(folder / ".a.abcdef"));
    pending.commit();
    EXPECT_EQ(read_file(folder / "a"), "half");
}

TEST_F(Files, a_file_appears_with_its_bytes_and_nothing_beside_it)
{
    write_file(folder / "a", "first");
    write_file(folder / "a", std::string("sec\0nd", 6));
    EXPECT_EQ(read_file(folder / "a"), std::string("sec\0nd", 6));
    EXPECT_EQ(count(), 1U);
}

TEST_F(Files, a_disk_that_is_full_leaves_the_old_file_and_no_part_of_the_new)
{
    write_file(folder / "a", "old");
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(write_file(folder / "a", std::string(5000, 'x')), Failure);
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(read_file(folder / "a"), "old");
    EXPECT_EQ(count(), 1U);
}

TEST_F(Files, a_pending_file_appears_when_it_is_committed_with_each_byte_in_its_place)
{
    write_file(folder / "a", "the old one");
    PendingFile file(folder / "a");
    file.write(3, "def");
    file.write(0, "abc");
    EXPECT_EQ(read_file(folder / "a"), "the old one");
    file.commit();
    EXPECT_EQ(read_file(folder / "a"), "abcdef");
    EXPECT_EQ(count(), 1U);
}

TEST_F(Files, a_pending_file_that_is_given_up_leaves_nothing)
{
    {
        PendingFile file(folder / "a");
        file.write(0, "abc");
        EXPECT_EQ(count(), 1U);
    }
    EXPECT_EQ(count(), 0U);
    EXPECT_THROW(PendingFile(folder / "none" / "a"), Failure);
}

TEST_F(Files, a_pipe_is_given_nothing_before_all_is_there)
{
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const int reader = ::open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    PendingFile file(folder / "pipe");
    file.write(1, "bc");
    char bytes[4] = {};
    EXPECT_EQ(::read(reader, bytes, sizeof bytes), 0);
    file.write(0, "a");
    file.commit();
    EXPECT_EQ(::read(reader, bytes, sizeof bytes), 3);
    EXPECT_STREQ(bytes, "abc");
    ::close(reader);
    EXPECT_EQ(count(), 1U);
}

TEST_F(Files, where_no_temporary_file_can_be_made_memory_takes_its_place)
{
    ::setenv("TMPDIR", (folder / "none").c_str(), 1);
    EXPECT_NO_THROW({
        PendingFile file("/dev/null");
        file.write(0, "x");
        file.commit();
    });
    ::unsetenv("TMPDIR");
}

TEST_F(Files, a_full_device_is_an_error_that_says_so)
{
    try {
        write_file("/dev/full", "x");
        FAIL() << "was written";
    } catch (const Failure& e) {
        EXPECT_NE(std::string(e.what()).find("No space left"), std::string::npos) << e.what();
    }
}

TEST_F(Files, what_is_no_regular_file_is_written_to_and_stays)
{
    write_file("/dev/null", "x");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Files, a_link_stays_and_its_target_is_replaced)
{
    write_file(folder / "target", "old");
    fs::create_symlink("target", folder / "link");
    write_file(folder / "link", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_file(folder / "target"), "new");
}

TEST_F(Files, a_place_that_cannot_be_written_is_found_beforehand)
{
    EXPECT_NO_THROW(require_writable(folder / "new"));
    EXPECT_THROW(require_writable(folder), Failure);
    EXPECT_THROW(require_writable(folder / "none" / "a"), Failure);
    EXPECT_THROW(write_file(folder / "none" / "a", "x"), Failure);
    EXPECT_THROW(read_file(folder / "none"), Failure);
}

TEST_F(Files, a_cached_program_comes_back_only_whole_and_under_its_key)
{
    const std::string binary("\0binary", 7);
    ASSERT_TRUE(store_cached(folder / "cache", "key", binary));
    EXPECT_EQ(load_cached(folder / "cache", "key"), binary);
    EXPECT_FALSE(load_cached(folder / "cache", "other"));
    const fs::path file = fs::directory_iterator(folder / "cache")->path();
    std::string content = read_file(file);
    content.back() ^= 1;
    write_file(file, content);
    EXPECT_FALSE(load_cached(folder / "cache", "key")) << "a flipped bit went unnoticed";
    write_file(file, content.substr(0, 50));
    EXPECT_FALSE(load_cached(folder / "cache", "key"));
}

TEST_F(Files, a_cache_that_cannot_be_written_is_no_error)
{
    write_file(folder / "file", "x");
    EXPECT_FALSE(store_cached(folder / "file" / "cache", "key", "b"));
    EXPECT_FALSE(store_cached({}, "key", "b"));
}

TEST(ProgramCache, every_part_of_the_device_and_of_the_source_is_in_the_key)
{
    const DeviceInfo device;
    const std::string key = cache_key("source", "options", device);
    EXPECT_NE(key, cache_key("source2", "options", device));
    EXPECT_NE(key, cache_key("source", "options2", device));
    EXPECT_NE(cache_key("ab", "c", device), cache_key("a", "bc", device));
    for (std::string DeviceInfo::*part : {&DeviceInfo::platform_name, &DeviceInfo::platform_version, &DeviceInfo::name,
                                          &DeviceInfo::vendor, &DeviceInfo::version, &DeviceInfo::driver}) {
        DeviceInfo other;
        other.*part += 'x';
        EXPECT_NE(key, cache_key("source", "options", other));
    }
}

TEST(ProgramCache, it_is_left_to_platforms_that_keep_one_themselves)
{
    DeviceInfo device;
    EXPECT_TRUE(uses_cache(KernelCache::automatic, device));
    device.platform_name = "Portable Computing Language";
    EXPECT_FALSE(uses_cache(KernelCache::automatic, device));
    EXPECT_TRUE(uses_cache(KernelCache::always, device));
    EXPECT_FALSE(uses_cache(KernelCache::off, {}));
}

TEST(Sha256, digests_are_those_of_the_standard)
{
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

} // namespace
} // namespace clucida::host
