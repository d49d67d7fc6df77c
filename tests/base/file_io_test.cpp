#include "base/file_io.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>

#include "worlds/scratch_folder.h"

namespace fb {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void put(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

std::span<const std::uint8_t> bytesOf(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

// Runs `work` in a child process and waits for it. What it does to limits and signals stays there.
int inChild(const std::function<int()>& work) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(work());
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST(FileReader, ReadsAnyPartAtAnyOffset) {
    const ScratchFolder folder;
    put(folder / "a", "0123456789");
    const Result<FileReader> reader = FileReader::open(folder / "a");
    ASSERT_TRUE(reader) << reader.error().oneLine();
    EXPECT_EQ(reader->sizeBytes(), 10u);
    EXPECT_EQ(reader->path(), folder / "a");
    Bytes three(3);
    ASSERT_TRUE(reader->readAt(7, three));
    EXPECT_EQ(three, (Bytes{'7', '8', '9'}));
    ASSERT_TRUE(reader->readAt(0, three));
    EXPECT_EQ(three, (Bytes{'0', '1', '2'}));
    EXPECT_TRUE(reader->readAt(10, {})) << "nothing can be read anywhere";
}

TEST(FileReader, SaysAtWhichByteTheFileEndsTooEarly) {
    const ScratchFolder folder;
    put(folder / "a", "0123456789");
    const Result<FileReader> reader = FileReader::open(folder / "a");
    Bytes four(4);
    const Result<void> read = reader->readAt(8, four);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().oneLine(), (folder / "a").string() + ": byte 10: the file ends too early");
    EXPECT_FALSE(reader->readAt(11, four));
    EXPECT_FALSE(reader->readAt(~std::uint64_t{0} - 2, four)) << "beyond any file";
}

TEST(FileReader, SeesAFileThatWasCutShortAfterItWasOpened) {
    const ScratchFolder folder;
    put(folder / "a", "0123456789");
    const Result<FileReader> reader = FileReader::open(folder / "a");
    ASSERT_EQ(::truncate((folder / "a").c_str(), 4), 0);
    Bytes ten(10);
    const Result<void> read = reader->readAt(0, ten);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().place, "byte 4");
}

TEST(FileReader, KeepsReadingAFileThatWasRemoved) {
    const ScratchFolder folder;
    put(folder / "a", "0123");
    const Result<FileReader> reader = FileReader::open(folder / "a");
    std::filesystem::remove(folder / "a");
    Bytes four(4);
    EXPECT_TRUE(reader->readAt(0, four));
}

TEST(FileReader, SaysWhyItCannotOpenWhatIsMissingOrNoFile) {
    const ScratchFolder folder;
    const Result<FileReader> missing = FileReader::open(folder / "missing");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().oneLine(),
              (folder / "missing").string() + ": cannot be opened: No such file or directory");
    const Result<FileReader> isFolder = FileReader::open(folder.path());
    ASSERT_FALSE(isFolder);
    EXPECT_EQ(isFolder.error().reason, "is not a file");
}

TEST(FileReader, DoesNotWaitForTheOtherEndOfAPipe) {
    const ScratchFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const int status = inChild([&] {
        ::alarm(5);  // kills the child should it wait
        const Result<FileReader> reader = FileReader::open(folder / "pipe");
        return !reader && reader.error().reason == "is not a file" ? 0 : 1;
    });
    EXPECT_EQ(status, 0);
}

TEST(FileReader, HandsItsFileOverWhenMoved) {
    const ScratchFolder folder;
    put(folder / "a", "aaaa");
    put(folder / "b", "bb");
    Result<FileReader> a = FileReader::open(folder / "a");
    Result<FileReader> b = FileReader::open(folder / "b");
    FileReader moved = std::move(*a);
    EXPECT_EQ(moved.sizeBytes(), 4u);
    moved = std::move(*b);
    EXPECT_EQ(moved.sizeBytes(), 2u);
    Bytes two(2);
    ASSERT_TRUE(moved.readAt(0, two));
    EXPECT_EQ(two, (Bytes{'b', 'b'}));
}

TEST(ReadFile, GivesAllBytesAndRefusesAFileAboveTheCap) {
    const ScratchFolder folder;
    put(folder / "a", std::string("x\0y\n", 4));
    const Result<Bytes> bytes = readFile(folder / "a", 4);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(*bytes, (Bytes{'x', 0, 'y', '\n'}));
    const Result<Bytes> refused = readFile(folder / "a", 3);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason, "is larger than 3 bytes");
    put(folder / "empty", "");
    EXPECT_TRUE(readFile(folder / "empty", 0)->empty());
}

TEST(AtomicFile, GivesTheNameOnlyWhenItIsFinished) {
    const ScratchFolder folder;
    Result<AtomicFile> file = AtomicFile::create(folder / "a");
    ASSERT_TRUE(file) << file.error().oneLine();
    ASSERT_TRUE(file->write(bytesOf("first ")));
    EXPECT_EQ(file->offset(), 6u);
    ASSERT_TRUE(file->write(bytesOf("second")));
    EXPECT_EQ(file->offset(), 12u);
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    ASSERT_TRUE(file->finish());
    EXPECT_EQ(contentOf(folder / "a"), "first second");
    EXPECT_EQ(folder.entryCount(), 1);
    struct stat status {};
    ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0644u);
}

TEST(AtomicFile, LeavesNothingBehindWhenItIsDropped) {
    const ScratchFolder folder;
    {
        Result<AtomicFile> file = AtomicFile::create(folder / "a");
        ASSERT_TRUE(file->write(bytesOf("half a sen")));
        EXPECT_EQ(folder.entryCount(), 1);
    }
    EXPECT_EQ(folder.entryCount(), 0);
}

TEST(AtomicFile, KeepsTheOldContentUntilTheNewIsComplete) {
    const ScratchFolder folder;
    put(folder / "a", "old");
    {
        Result<AtomicFile> file = AtomicFile::create(folder / "a");
        ASSERT_TRUE(file->write(bytesOf("new")));
    }
    EXPECT_EQ(contentOf(folder / "a"), "old");
    ASSERT_TRUE(writeFileAtomically(folder / "a", std::string_view("new")));
    EXPECT_EQ(contentOf(folder / "a"), "new");
}

TEST(AtomicFile, AKilledWriterLeavesNoFileOfThatName) {
    const ScratchFolder folder;
    const int status = inChild([&] {
        Result<AtomicFile> file = AtomicFile::create(folder / "a");
        (void)file->write(bytesOf("half a sen"));
        ::kill(::getpid(), SIGKILL);
        return 0;
    });
    EXPECT_EQ(status, 128 + SIGKILL);
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        EXPECT_EQ(entry.path().extension(), ".part") << "what is left can be told from files";
    }
}

TEST(AtomicFile, AFullDiskIsAnErrorWithPlaceAndLeavesNothing) {
    const ScratchFolder folder;
    put(folder / "a", "old");
    const int status = inChild([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{100, 100};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        Result<AtomicFile> file = AtomicFile::create(folder / "a");
        if (!file->write(bytesOf(std::string(60, 'x')))) return 1;
        const Result<void> tooMuch = file->write(bytesOf(std::string(60, 'y')));
        if (tooMuch) return 2;
        if (tooMuch.error().place != "byte 100") return 3;  // the first 40 bytes went in: a short write
        if (folder.entryCount() != 1) return 4;
        if (file->write(bytesOf("z"))) return 5;  // a failure is final
        return file->finish() ? 6 : 0;
    });
    EXPECT_EQ(status, 0);
    EXPECT_EQ(contentOf(folder / "a"), "old");
}

TEST(AtomicFile, SaysWhyItCannotWriteThere) {
    const ScratchFolder folder;
    const Result<AtomicFile> file = AtomicFile::create(folder / "missing/a");
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().oneLine(),
              (folder / "missing/a").string() + ": cannot be written: No such file or directory");
    std::filesystem::create_directory(folder / "taken");
    const Result<void> onFolder = writeFileAtomically(folder / "taken", std::string_view("x"));
    ASSERT_FALSE(onFolder);
    EXPECT_EQ(onFolder.error().reason, "cannot be given its name: Is a directory");
    EXPECT_EQ(folder.entryCount(), 1);
}

TEST(AtomicFile, TheOneItIsAssignedToRemovesItsOwnUnfinishedFile) {
    const ScratchFolder folder;
    {
        Result<AtomicFile> a = AtomicFile::create(folder / "a");
        Result<AtomicFile> b = AtomicFile::create(folder / "b");
        ASSERT_TRUE(b->write(bytesOf("b")));
        *a = std::move(*b);
        EXPECT_EQ(a->offset(), 1u);
        ASSERT_TRUE(a->finish());
    }
    EXPECT_EQ(contentOf(folder / "b"), "b");
    EXPECT_EQ(folder.entryCount(), 1);
}

TEST(MakeFolder, MakesParentsAndIsContentWithWhatIsThere) {
    const ScratchFolder folder;
    EXPECT_TRUE(makeFolder(folder / "x/y/z"));
    EXPECT_TRUE(std::filesystem::is_directory(folder / "x/y/z"));
    EXPECT_TRUE(makeFolder(folder / "x/y/z"));
}

TEST(MakeFolder, SaysWhichFolderCannotBeMade) {
    const ScratchFolder folder;
    put(folder / "file", "");
    for (const char* name : {"file", "file/below"}) {
        const Result<void> made = makeFolder(folder / name);
        ASSERT_FALSE(made) << name;
        EXPECT_EQ(made.error().file, (folder / name).string());
        EXPECT_NE(made.error().reason, "");
    }
}

}  // namespace
}  // namespace fb
