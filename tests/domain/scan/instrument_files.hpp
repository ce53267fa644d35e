#pragma once

#include "domain/scan/scan.hpp"
#include "domain/text/bytes.hpp"
#include "domain/text/zip.hpp"

#include <cmath>
#include <string>
#include <vector>

/// Files as instruments write them, byte by byte from the formats' descriptions: maps of 2 rows of 9 points,
/// 2 µm and 3 µm apart, heights in steps of 10 nm; the last but one of the second row was not measured.
namespace testing {

inline constexpr int map_columns = 9, map_rows = 2;
inline const std::vector<int> map_heights{3, -2, 4, 1, -5, 9, 2, 6, 5, 7, -3, 5, 3, -1, 0, 4, -8, 2};
inline constexpr std::size_t map_gap = 16;

inline void put(std::string& bytes, std::size_t at, auto value) {
    std::string part;
    rough::append_little_endian(part, value);
    bytes.replace(at, part.size(), part);
}

/// ISO 25178-71, binary; `type` as in missing_mark().
inline std::string sdf_file(int type = 5) {
    std::string bytes = "bISO-1.0" + std::string(73, ' ');
    put(bytes, 42, std::uint16_t(map_columns)), put(bytes, 44, std::uint16_t(map_rows));
    put(bytes, 46, 2e-6), put(bytes, 54, 3e-6), put(bytes, 62, 1e-8), put(bytes, 70, 0.0);
    bytes[78] = 0, bytes[79] = char(type), bytes[80] = 0;
    for (std::size_t i = 0; i < map_heights.size(); ++i)
        if (type == 4)
            rough::append_little_endian(bytes, std::int8_t(map_heights[i])); // has no mark of a missing value
        else if (type == 5)
            rough::append_little_endian(bytes, std::int16_t(i == map_gap ? -32768 : map_heights[i]));
        else if (type == 6)
            rough::append_little_endian(bytes,
                                        i == map_gap ? std::numeric_limits<int>::min() : map_heights[i]);
        else
            rough::append_little_endian(bytes, i == map_gap ? std::nan("") : double(map_heights[i]));
    return bytes;
}

/// Digital Surf, 16 or 32 bits, with a comment and a private zone before the heights.
inline std::string sur_file(int bits = 32) {
    std::string bytes(512, '\0');
    bytes.replace(0, 12, "DIGITAL SURF");
    put(bytes, 14, std::int16_t(1)), put(bytes, 18, std::int16_t(2));
    put(bytes, 86, std::int16_t(1)), put(bytes, 98, std::int16_t(bits));
    put(bytes, 100, -8), put(bytes, 104, 9), put(bytes, 108, map_columns), put(bytes, 112, map_rows);
    put(bytes, 120, 0.002f), put(bytes, 124, 3.f), put(bytes, 128, 0.01f);
    bytes.replace(180, 2, "mm"), bytes.replace(196, 2, "\xB5m"), bytes.replace(212, 2, "\xB5m");
    put(bytes, 334, std::int16_t(5)), put(bytes, 336, std::int16_t(3));
    bytes += "notes...";
    for (std::size_t i = 0; i < map_heights.size(); ++i) {
        const int height = i == map_gap ? -10 : map_heights[i];
        if (bits == 16)
            rough::append_little_endian(bytes, std::int16_t(height));
        else
            rough::append_little_endian(bytes, height);
    }
    return bytes;
}

/// Gwyddion's simple field.
inline std::string gsf_file(const std::string& title = "t") {
    std::string bytes = "Gwyddion Simple Field 1.0\nXRes = 9\nYRes = 2\nXReal = 1.8e-5\nYReal = 6e-6\n"
                        "XYUnits = m\nZUnits = m\nTitle = " +
                        title + "\n";
    bytes.append(4 - bytes.size() % 4, '\0');
    for (std::size_t i = 0; i < map_heights.size(); ++i)
        rough::append_little_endian(bytes, i == map_gap ? std::nanf("") : float(1e-8 * map_heights[i]));
    return bytes;
}

/// main.xml of an X3P file of 16 bit heights with a mask of the valid points.
inline std::string x3p_xml() {
    return "<?xml version=\"1.0\"?>\n<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">"
           "<Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>"
           "<CX><AxisType>I</AxisType><DataType>D</DataType><Increment>2e-6</Increment></CX>"
           "<CY><AxisType>I</AxisType><DataType>D</DataType><Increment>3e-6</Increment></CY>"
           "<CZ><AxisType>A</AxisType><DataType>I</DataType><Increment>1e-8</Increment></CZ></Axes></Record1>"
           "<Record3><MatrixDimension><SizeX>9</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></MatrixDimension>"
           "<DataLink><PointDataLink>bindata/data.bin</PointDataLink>"
           "<ValidPointsLink>bindata/valid.bin</ValidPointsLink></DataLink></Record3></p:ISO5436_2>";
}

template <class Number = std::int16_t>
std::string x3p_data() {
    std::string data;
    for (const int height : map_heights)
        rough::append_little_endian(data, Number(height));
    return data;
}

/// Heights of a type other than I, the archive's paths from here.
inline std::string x3p_file(char type = 'I') {
    std::string valid(3, '\xFF'), xml = x3p_xml();
    valid[map_gap / 8] = char(~(1 << map_gap % 8));
    xml[xml.find("<DataType>I") + 10] = type;
    if (type != 'I')
        for (const std::string path : {"bindata/data", "bindata/valid"})
            xml.replace(xml.find(path), 0, "./");
    return rough::zipped({{"main.xml", xml},
                          {"bindata/data.bin", type == 'L'   ? x3p_data<std::int32_t>()
                                               : type == 'F' ? x3p_data<float>()
                                               : type == 'D' ? x3p_data<double>()
                                                             : x3p_data()},
                          {"bindata/valid.bin", valid}});
}

} // namespace testing
