#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "tests/catch.hpp"
#include "tests/folder.hpp"

#include <sys/stat.h>
#include <thread>

namespace fs = std::filesystem;
using tests::Folder;

namespace {
long entries(const fs::path& folder) { return std::distance(fs::directory_iterator(folder), fs::directory_iterator{}); }
} // namespace

TEST_CASE("a file written atomically has exactly the new content") {
    const Folder folder;
    const fs::path file = folder / "curve.csv";
    const std::string bytes("old\0\r\n\xff and long", 17);
    rough::write_atomically(file, bytes);
    CHECK(rough::read_whole(file) == bytes);
    rough::write_atomically(file, "");
    CHECK(rough::read_whole(file).empty());
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a file that cannot be written is refused in one line, without a trace") {
    const Folder folder;
    CHECK_THROWS_AS(rough::write_atomically(folder / "missing" / "a.csv", "x"), rough::InputError);
    fs::create_directory(folder / "taken");
    CHECK_THROWS_WITH(rough::write_atomically(folder / "taken", "x"),
                      Catch::Contains("taken") && !Catch::Contains("\n"));
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a written file replaces a symbolic link and leaves the link's file unchanged") {
    const Folder folder;
    fs::create_directory(folder / "far");
    folder.write("far/curve.csv", "old");
    fs::create_symlink("far/curve.csv", folder / "link.csv");
    fs::create_symlink("far/new.csv", folder / "dangling.csv");
    for (const char* name : {"link.csv", "dangling.csv"}) {
        rough::write_atomically(folder / name, "new");
        CHECK_FALSE(fs::is_symlink(folder / name));
        CHECK(rough::read_whole(folder / name) == "new");
    }
    CHECK(rough::read_whole(folder / "far/curve.csv") == "old");
    CHECK(entries(folder / "far") == 1);
}

TEST_CASE("a chain of links is followed to its end, and a loop is refused") {
    const Folder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("far/c", folder / "b");
    CHECK(rough::without_links(folder / "a") == folder / "far/c");
    fs::create_symlink("loop", folder / "loop");
    CHECK_THROWS_WITH(rough::without_links(folder / "loop"), Catch::Contains("loop"));
}

TEST_CASE("a replaced file keeps its mode") {
    const Folder folder;
    const fs::path file = folder.write("secret.csv", "old");
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    rough::write_atomically(file, "new");
    CHECK(fs::status(file).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("a file above the maximum size and a device are refused") {
    const Folder folder;
    const fs::path file = folder.write("sparse.txt", "");
    fs::resize_file(file, 3'000'000'000'000);
    CHECK_THROWS_WITH(rough::read_whole(file), Catch::Contains("400000000 bytes"));
    CHECK_THROWS_WITH(rough::read_whole("/dev/zero", 1000), Catch::Contains("is a device"));
    CHECK(rough::read_whole(folder.write("full", std::string(1000, 'x')), 1000).size() == 1000);
}

TEST_CASE("a pipe is written to directly, and a full device is refused") {
    const Folder folder;
    const fs::path pipe = folder / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    std::string read;
    std::thread reader([&] { read = rough::read_whole(pipe); });
    rough::write_atomically(pipe, "curve");
    reader.join();
    CHECK(read == "curve");
    CHECK(fs::is_fifo(pipe));
    fs::create_symlink("/dev/full", folder / "full");
    CHECK_THROWS_AS(rough::write_atomically(folder / "full", "x"), rough::InputError);
    CHECK(fs::is_character_file("/dev/full"));
    CHECK(entries(folder.path()) == 2);
}
