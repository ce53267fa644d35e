#pragma once

#include "domain/scan/scan.hpp"
#include "domain/text/unit.hpp"
#include "domain/text/words.hpp"

namespace rough {

/// A profile or a map (mm) as the bytes of an X3P file (ISO 25178-72): double precision, metres, with the
/// standard's check sums. NaN is a missing height.
std::string x3p(const Profile& surface);

/// A profile or a map (mm) as the bytes of a Digital Surf file (PRO or SUR): heights in whole numbers of 32
/// bits, exact if they are multiples of a step, else to 5e-10 of the highest |height|. NaN is a missing
/// height. Throws InputError on over 2^31 - 1 heights, and on steps or spacings beyond single precision.
std::string sur(const Profile& surface);

/// How numbers were rounded when they were written: to a digit, or to significant digits.
struct Rounding {
    double digit = 0; ///< one unit in the last written digit of the finest number
    double share = 0; ///< one unit in the last significant digit, divided by the number; an upper bound
};

/// Heights at evenly spaced points, from a file whose format has units and spacings. Rows are along x, and y
/// grows from row to row. A profile is a map of one row.
struct HeightMap {
    std::string format;           ///< e.g. "ISO 5436-2 (SMD)"
    double spacing = 0;           ///< between the points of a row, mm
    double row_spacing = 0;       ///< between rows, mm; 0 for a profile
    Index rows = 1;               ///< at least 1
    LengthUnit height_unit = {};  ///< unit of the heights in the file
    double height_factor = 1;     ///< factor that converts a stored number to `height_unit`
    Eigen::VectorXd heights = {}; ///< row after row, as stored; NaN if not measured
    std::vector<int> line = {};   ///< line of each height in a text file; empty for a binary one
    long announced = -1;          ///< number of heights that the file states; -1: none stated
    std::vector<double> x = {};   ///< x of each height, mm, NaN if missing; empty with a known spacing
    Rounding rounding = {};       ///< rounding of x, mm
    std::string units = {};       ///< units and spacing, with their sources, in words

    Index columns() const { return heights.size() / rows; } ///< points of a row
};

/// Throws InputError on a file without points, on over 1e7 points in one line, and on over 2e7 on a map.
void expect_points(std::int64_t columns, std::int64_t rows, const std::string& file);

/// The number that marks a missing value of a type; NaN if the type has no mark. Types have ISO 25178-71's
/// numbers, 0 to 7: uint8, uint16, uint32, float, int8, int16, int32, double.
double missing_mark(int type);

/// The first `count` numbers of a type as in missing_mark(), lowest byte first; NaN for `missing` and for
/// numbers that are not finite. Throws InputError on another type and on too few bytes.
Eigen::VectorXd stored_numbers(std::string_view bytes, std::int64_t count, int type, double missing,
                               const std::string& file);

/// Whether a file that begins with these bytes is one that binary_map reads.
bool is_binary_map(std::string_view head);
/// Reads binary maps: surface data files (ISO 25178-71 SDF, BCR), Digital Surf's SUR and PRO, and Gwyddion's
/// GSF and GWY. Returns nothing if the bytes begin otherwise. Sizes are compared with the bytes before memory
/// is allocated. Throws InputError with one line on a file that cannot be read.
std::optional<HeightMap> binary_map(const std::string& bytes, const std::string& file);

/// Reads ASCII surface data files (ISO 25178-71 SDF, BCR) and softgauges (ISO 5436-2 SMD). Also reads
/// Talysurf's PRF (as in NPL's softgauges), PTB's PR, SigmaSurf's files, Wyko's ASC and Zygo's XYZ. Returns
/// nothing for other lines. Throws InputError with file and line on a file that is not a profile or a map.
std::optional<HeightMap> text_map(const Lines& lines, const std::string& file);

class Zip;

/// Reads an X3P file (ISO 25178-72, ISO 5436-2): a zip archive of main.xml and usually binary heights, x and
/// y incremental, lengths in metres. The entries may be in a folder. Its check sums are verified. Throws
/// InputError with one line if it cannot be read.
HeightMap read_x3p(const Zip& archive, const std::string& file);

/// Reads the first data field with a length unit of a Gwyddion file (GWY, version 2): names, sizes and typed
/// values, lowest byte first. Points under its mask are missing. Throws InputError if it cannot be read.
HeightMap read_gwy(const std::string& bytes, const std::string& file);

/// The cells of an Excel workbook's sheet (XLSX) as lines with semicolons: the sheet with the most numbers.
/// Returns nothing if the archive has no sheets. Throws InputError if it cannot be read.
std::optional<std::string> sheet_of(const Zip& archive, const std::string& file);

} // namespace rough
