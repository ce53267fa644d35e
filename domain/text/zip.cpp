#include "domain/text/zip.hpp"

#include "domain/errors.hpp"

#include <algorithm>
#include <zip.h>

namespace rough {
namespace {

struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
    void operator()(zip_file_t* entry) const { zip_fclose(entry); }
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};
template <class T>
using Owned = std::unique_ptr<T, Discard>;

void expect(bool done, const char* what) {
    if (!done) throw std::runtime_error(std::string("zip archive: cannot ") + what);
}

} // namespace

Zip::Zip(const std::string& bytes, std::string file)
    : archive_(nullptr, zip_discard), file_(std::move(file)),
      max_unpacked_(std::max<std::size_t>(40'000'000, 20 * bytes.size())) {
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, nullptr);
    expect(source != nullptr, "be opened");
    archive_.reset(zip_open_from_source(source, ZIP_RDONLY, nullptr));
    if (!archive_) {
        zip_source_free(source);
        throw InputError(file_ + ": is a damaged zip archive; give an X3P or XLSX file");
    }
}

std::optional<std::string> Zip::entry(const std::string& name, std::size_t max_size) const {
    zip_stat_t found;
    if (zip_stat(archive_.get(), name.c_str(), ZIP_FL_NOCASE, &found) != 0) return std::nullopt;
    if (const std::size_t max = std::min(max_size, max_unpacked_); found.size > max)
        throw InputError(file_ + ": its entry " + name + " is too large; give one of at most " + std::to_string(max) +
                         " bytes");
    const Owned<zip_file_t> opened(zip_fopen_index(archive_.get(), found.index, 0));
    std::string bytes(found.size, '\0');
    if (!opened || zip_fread(opened.get(), bytes.data(), bytes.size()) != std::ssize(bytes))
        throw InputError(file_ + ": its entry " + name + " is damaged; export it again");
    return bytes;
}

std::string Zip::folder_of(const std::string& name) const {
    const auto index = zip_name_locate(archive_.get(), name.c_str(), ZIP_FL_NOCASE | ZIP_FL_NODIR);
    const char* path = index < 0 ? nullptr : zip_get_name(archive_.get(), static_cast<zip_uint64_t>(index), 0);
    const std::string full = path ? path : "";
    return full.substr(0, full.rfind('/') + 1); // npos + 1 is 0
}

std::string zipped(const std::vector<std::pair<std::string, std::string>>& entries) {
    const Owned<zip_source_t> memory(zip_source_buffer_create(nullptr, 0, 0, nullptr));
    expect(memory != nullptr, "be made");
    zip_source_keep(memory.get()); // one for the archive, one to read what it wrote
    Owned<zip_t> zip(zip_open_from_source(memory.get(), ZIP_CREATE | ZIP_TRUNCATE, nullptr));
    if (!zip) zip_source_free(memory.get());
    expect(zip != nullptr, "be made");
    for (const auto& [name, content] : entries) {
        zip_source_t* source = zip_source_buffer(zip.get(), content.data(), content.size(), 0);
        const auto index = zip_file_add(zip.get(), name.c_str(), source, ZIP_FL_ENC_UTF_8);
        constexpr zip_uint16_t first_day = 1 << 5 | 1; // month 1, day 1 of 1980
        const auto entry = static_cast<zip_uint64_t>(index);
        constexpr zip_uint32_t fastest = 1; // the usual level takes seconds for a mesh
        expect(index >= 0 && zip_file_set_dostime(zip.get(), entry, 0, first_day, 0) == 0 &&
                   zip_set_file_compression(zip.get(), entry, ZIP_CM_DEFLATE, fastest) == 0,
               "take an entry");
    }
    expect(zip_close(zip.get()) == 0, "be written");
    zip.release();
    zip_stat_t written;
    expect(zip_source_stat(memory.get(), &written) == 0 && zip_source_open(memory.get()) == 0, "be read");
    std::string bytes(written.size, '\0');
    expect(zip_source_read(memory.get(), bytes.data(), bytes.size()) == std::ssize(bytes) &&
               zip_source_close(memory.get()) == 0,
           "be read");
    return bytes;
}

} // namespace rough
