#pragma once

#include "domain/numerics/grid.hpp"
#include "domain/scan/unit.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rough {

/// Heights at even points whose file says all about them in a layout of its own: rows along x, y growing
/// from row to row; a profile is a map of one row.
struct HeightMap {
    std::string format;           ///< e.g. "ISO 5436-2 (SMD)"
    double spacing = 0;           ///< of the points of a row, mm
    double row_spacing = 0;       ///< of the rows, mm; 0 of a profile
    Index rows = 1;               ///< at least 1
    LengthUnit height_unit = {};  ///< as the file names it
    double height_factor = 1;     ///< a stored number times this is in `height_unit`
    Eigen::VectorXd heights = {}; ///< row after row, as stored; NaN if none was measured
    std::vector<int> line = {};   ///< line of each height in a text file; empty for a binary one
    long announced = -1;          ///< how many heights the file says it has; -1: it does not

    Index columns() const { return heights.size() / rows; } ///< points of a row
};

/// Throws InputError on a file of no points, of more than 1e7 along a line, or of more than 2e7 on a map.
void expect_points(std::int64_t columns, std::int64_t rows, const std::string& file);

/// The value that stands for "not measured" among numbers of a type, by ISO 25178-71's number of the type (0
/// to 7: uint8, uint16, uint32, float, int8, int16, int32, double); NaN if the type has none.
double missing_mark(int type);

/// Whether a file that begins with these bytes is one that binary_map reads.
bool is_binary_map(std::string_view head);
/// Reads binary surface data files (ISO 25178-71 SDF, BCR), Digital Surf's SUR and PRO (not compressed),
/// Gwyddion's simple field (GSF) and X3P (ISO 25178-72); nothing if the bytes begin as none of these.
/// Sizes are held against the bytes that are there before anything is allocated. Throws InputError with one
/// line on a file that cannot be read.
std::optional<HeightMap> binary_map(const std::string& bytes, const std::string& file);

/// Reads ASCII surface data files (ISO 25178-71 SDF, BCR), softgauges (ISO 5436-2 SMD), Talysurf's PRF (as
/// NPL's softgauges have it), PTB's PR, and SigmaSurf's data files; nothing if the lines are none of
/// these. Throws InputError naming file and line on one that cannot be read as a profile or a map.
std::optional<HeightMap> text_map(const std::vector<std::string_view>& lines, const std::string& file);

/// Numbers of one type, lowest byte first, that arrive in pieces of any size.
class StoredNumbers {
  public:
    /// For `count` numbers of a type as in missing_mark(), of which `missing` is none. Throws InputError on
    /// another type.
    StoredNumbers(std::int64_t count, int type, double missing, const std::string& file);
    std::int64_t bytes() const { return count_ * size_; } ///< that the numbers take
    void take(std::string_view piece); ///< the next bytes; those behind the last number are ignored
    /// The numbers, NaN for `missing` and for those that are not finite. Throws InputError if bytes are
    /// lacking.
    Eigen::VectorXd numbers();

  private:
    std::int64_t count_, size_, taken_ = 0;
    int type_;
    double missing_;
    std::string file_, part_; ///< the first bytes of a number
    Eigen::VectorXd numbers_;
};

/// Reads an X3P file (ISO 25178-72, ISO 5436-2): a zip archive of main.xml and, mostly, binary heights, x and
/// y incremental, lengths in metres. Check sums that it gives are verified. Throws InputError with one line
/// if it cannot be read.
HeightMap read_x3p(const std::string& bytes, const std::string& file);

/// Hands an archive's entry, of at most `max_size` bytes, to `take` in pieces; false if there is none.
using ReadEntry = std::function<bool(const std::string& name, std::size_t max_size,
                                     const std::function<void(std::string_view)>& take)>;
/// The map that main.xml describes. Throws InputError as read_x3p.
HeightMap read_x3p_description(std::string xml, const ReadEntry& read, const std::string& file);

} // namespace rough
