#include "tests/domain/scan/quirk_files.hpp"

#include <cstdio>

namespace {

std::string number(double value, int decimals, char point) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    std::string written = text;
    for (char& c : written)
        if (c == '.') c = point;
    return written;
}

struct Form {
    std::string separator = "\t";
    std::string end = "\n";
    char point = '.';
    double x_unit = 1;      ///< mm
    double height_unit = 1; ///< mm
    std::string before = {}, behind = {};
    int x_decimals = 7, height_decimals = 7;
};

std::string x_at(std::size_t i, const Form& form) {
    return number(double(i) * quirk_spacing / form.x_unit, form.x_decimals, form.point);
}

std::string height_at(std::size_t i, const Form& form) {
    return number(quirk_heights[i] / form.height_unit, form.height_decimals, form.point);
}

/// A header, then one line for each point.
std::string listed(const std::string& header, auto line) {
    std::string text = header;
    for (std::size_t i = 0; i < quirk_heights.size(); ++i) text += line(i);
    return text;
}

std::string two_columns(const Form& form) {
    return listed("", [&](std::size_t i) {
        return form.before + x_at(i, form) + form.separator + height_at(i, form) + form.behind + form.end;
    });
}

std::string one_column(const Form& form) {
    return listed("", [&](std::size_t i) { return height_at(i, form) + form.end; });
}

std::string utf16(const std::string& ascii) {
    std::string bytes = "\xFF\xFE";
    for (char c : ascii) bytes += c, bytes += '\0';
    return bytes;
}

std::string swapped(std::string text, const std::string& old, const std::string& fresh) {
    return text.replace(text.find(old), old.size(), fresh);
}

std::vector<QuirkFile> columns() {
    const auto decimal_commas = [](const std::string& separator) {
        return Form{.separator = separator, .point = ',', .x_unit = 1e-3, .height_unit = 1e-3};
    };
    return {
        {"tabs", two_columns({})},
        {"blanks, aligned", two_columns({.separator = "   ", .before = "   "})},
        {"commas", two_columns({.separator = ","})},
        {"semicolons", two_columns({.separator = ";"})},
        {"semicolons and decimal commas", two_columns(decimal_commas(";")), "um"},
        {"tabs and decimal commas", two_columns(decimal_commas("\t")), "um"},
        {"comma, blank and decimal commas", two_columns(decimal_commas(", ")), "um"},
        {"one column", one_column({}), "", quirk_spacing},
        {"one column with decimal commas", one_column(decimal_commas("")), "um", 0.5},
        {"one column after its count", "8\n" + one_column({}), "", quirk_spacing},
        {"one row", one_column({.end = " "}) + "\n", "", quirk_spacing},
        {"a running index before x", listed("No.;x;z\n",
                                            [](std::size_t i) {
                                                return std::to_string(i + 1) + ";" + x_at(i, {}) + ";" +
                                                       height_at(i, {}) + "\n";
                                            })},
        {"a counter from 37 before x", listed("Counter\tx (mm)\tAltitude (mm)\n",
                                              [](std::size_t i) {
                                                  return std::to_string(i + 37) + "\t" + x_at(i, {}) + "\t" +
                                                         height_at(i, {}) + "\n";
                                              })},
        {"a running index for x",
         listed("", [](std::size_t i) { return std::to_string(i) + " " + height_at(i, {}) + "\n"; }), "",
         quirk_spacing},
        {"numbers in quotes", "\"x\",\"z\"\n" + two_columns({.separator = "\",\"", .before = "\"", .behind = "\""})},
        {"x running backwards",
         listed("", [last = quirk_heights.size() -
                            1](std::size_t i) { return x_at(last - i, {}) + " " + height_at(last - i, {}) + "\n"; })},
    };
}

std::vector<QuirkFile> headers() {
    const Form mixed{.separator = ";", .x_unit = 1, .height_unit = 1e-3};
    const Form nano{.separator = ",", .x_unit = 1e-3, .height_unit = 1e-6};
    const Form metres{.separator = " ", .x_unit = 1e3, .height_unit = 1e3, .x_decimals = 10, .height_decimals = 10};
    const Form angstrom{.separator = "\t", .x_unit = 1e-6, .height_unit = 1e-7};
    return {
        {"units in brackets", "x [mm];z [\xC2\xB5m]\n" + two_columns(mixed)},
        {"units in parentheses over blanks",
         "Position (mm)  Height (um)\n" + two_columns({.separator = "  ", .height_unit = 1e-3})},
        {"names without blanks between", "x[mm]z[um]\n" + two_columns(mixed)},
        {"units after a slash", "x/um,z/nm\n" + two_columns(nano)},
        {"two units by one key", "Units: x mm, z um\n" + two_columns(mixed)},
        {"units in words", "Lateral um,Raw Nanometer,\n" +
                               two_columns({.separator = ",", .x_unit = 1e-3, .height_unit = 1e-6, .behind = ",,"})},
        {"units in a separate line", "x;z\n[mm];[um]\n" + two_columns(mixed)},
        {"units alone and a count",
         "\xC2\xB5m \xC2\xB5m\n8\n" + two_columns({.separator = ", ", .x_unit = 1e-3, .height_unit = 1e-3})},
        {"Latin-1 units", "x [mm];z [\xB5m]\n" + two_columns(mixed)},
        {"Greek mu in UTF-8", "x [mm];z [\xCE\xBCm]\n" + two_columns(mixed)},
        {"metres", "x[m] z[m]\n" + two_columns(metres)},
        {"Angstrom", "x [nm]\tz [\xC3\x85]\n" + two_columns(angstrom)},
        {"units by key", "x-unit: um\nz-unit: nm\n" + two_columns(nano)},
        {"one named, the other given", "X_(microns),y1\n" + two_columns(nano), "nm"},
        {"Dektak export", "Scan Parameters\nScan Type,Standard Scan\nID,0\nStylus,Radius: 2.5 \xB5m\nLength,3.5 um\n"
                          "Resolution,0.5 um/sample\nR. Cursor,Pos: 1.0 um Width: 0.0 um\n\nAnalytical Results\n"
                          "Function,R.Cur Pos,Result\nRa,4.0 um,0.0052 um\n\nScan Data\nLateral um,Raw Micrometer,\n" +
                              two_columns({.separator = ",", .x_unit = 1e-3, .height_unit = 1e-3, .behind = ",,"})},
        {"HFM export", "X;Y;valid\n[mm];[mm];[1/0]\n" + two_columns({.separator = ";", .behind = ";1"})},
        {"matrix text with a width",
         "# Channel: Main\n# Width: 4 \xC2\xB5m\n# Value units: nm\n" + one_column({.height_unit = 1e-6})},
        {"SPIP's keys with a key for the lengths' unit",
         "# x-pixels = 8\n# x-length = 4\n# x-unit = um\n# z-unit = nm\n" + one_column({.height_unit = 1e-6})},
        {"a first width of nothing and a factor of no unit",
         "Width = 0 um\nHeight conversion factor (of a volt) = 3\nPixel size = 0.5 um\nValue units: nm\n" +
             one_column({.height_unit = 1e-6})},
        {"pixel size in a bracketed unit and height factor",
         "pixel size: 0.5[um]\nheight conversion factor (-> m) = 1e-6\n" + one_column({.height_unit = 1e-3})},
    };
}

/// Formats of instruments and metrology institutes.
std::vector<QuirkFile> named_layouts() {
    const std::string microns = one_column({.end = "\r\n", .height_unit = 1e-3});
    const std::string sdf = "ManufacID = maker\nCreateDate = 210520051200\nNumPoints = 8\nNumProfiles = 1\n"
                            "Xscale = 5E-07\nYscale = 0\nZscale = 1E-06\nZresolution = -1\nCompression = 0\n"
                            "DataType = 7\nCheckType = 0\n*\n";
    const std::string etx = "\x03\r\n";
    const auto nul = [](std::string text) {
        for (char& c : text)
            if (c == '~') c = '\0';
        return text;
    };
    return {
        {"ISO 25178-71 surface data file", "aISO-1.0\n" + sdf + one_column({.height_unit = 1e-3}) + "*\n*\n"},
        {"BCR with heights in rows and a trailer",
         "aBCR-1.0\n" + sdf + one_column({.end = "  ", .height_unit = 1e-3}) +
             "\n*\nConvertedBy = a program 1.2\nSampleIdentification = No. 3\n*\n"},
        {"ISO 5436-2 softgauge",
         nul("ISO 5436-2:2012~gauge.smd~\r\nPRF~ 1 ISO5436~\r\nCX~ I~ 8 mm~ 1.0e0 D~ 5.00000e-004 \r\n"
             "CZ~ A~ 8 um~ 1.0e0 D~\r\n" +
             etx + "DATE: 13-May-2005~\r\nCREATED_BY N. N.~\r\nCOMMENT /* 8 points */~\r\n" + etx) +
             microns + etx + "23456\r\n" + etx + "\x1a"},
        {"Talysurf PRF", "1 2\r\nSG2004 0.000000e+000 PRF\r\nCX M 8.000000e+000 MM 1.000000e+000 D\r\n"
                         "CZ M 8.000000e+000 MM 1.000000e-006 L\r\nEOR\r\nSTYLUS_RADIUS 0.000000e+000 MM\r\n"
                         "SPACING CX 5.000000e-004\r\nMAP 1.000000e+000 CZ CZ 1.000000e+000 1.000000e+000\r\nEOR\r\n" +
                             one_column({.end = "\r\n", .height_unit = 1e-6, .height_decimals = 0}) + "EOR\r\nEOF\r\n"},
        {"PTB's PR", "Profil C:\\a.pr\r\nX-len = 3.50000000 X-resolution 2000.000000 points/scanline: 8\r\n" +
                         microns.substr(0, microns.size() - 2)},
        {"PTB's PR in German",
         "Profil C:\\a.pr\r\nX-Ma\xDF = 3.5 X-Aufl\xF6sung 2000.0 Punkte/Zeile : 8\r\n" + microns},
        {"SigmaSurf",
         "SigmaSurf_Data 1.0\r\nIDENTIFICATION: No. 3\r\nDATE: 13 May 2005 - 12:00\r\nSPACING_UM: 0.50000\r\n"
         "NUMBER_OF_POINTS: 8\r\nPROFILE_UM:\r\n" +
             microns},
    };
}

std::vector<QuirkFile> text_forms() {
    const std::string rows = two_columns({});
    return {
        {"Windows line ends", two_columns({.end = "\r\n"})},
        {"doubled line ends", two_columns({.end = "\r\r\n"})},
        {"a blank line after every line", two_columns({.end = "\r\n\r\n"})},
        {"old Macintosh line ends", two_columns({.end = "\r"})},
        {"a UTF-8 mark", "\xEF\xBB\xBF" + rows},
        {"UTF-16", utf16(rows)},
        {"rows of empty cells", two_columns({.separator = ";"}) + ";\n;;;\n"},
        {"no last line end", rows.substr(0, rows.size() - 1)},
        {"blank lines at the end", rows + "\n \n\t\n"},
        {"trailing separators", two_columns({.separator = ";", .behind = ";;"})},
        {"comments above, between and behind",
         "% made by hand\n" + swapped(rows, "0.0010000", "0.0010000\n# pause") + "# end\n"},
        {"a remark behind a row", swapped(rows, "0.0030000\n", "0.0030000 # a scratch\n")},
        {"a title and a preamble", "Sample 7, ground steel\nOperator: N. N.\nSpeed = 0.5 mm/s\n\nx\tz\n" + rows},
        {"a count before two columns", "8\n" + rows},
        {"plus signs", two_columns({.before = "+"})},
        {"a typographic minus", swapped(rows, "-0.0025",
                                        "\xE2\x88\x92"
                                        "0.0025")},
        {"x rounded in its last digit", two_columns({.x_unit = 1, .x_decimals = 7}).replace(0, 9, "0.0000001")},
    };
}

} // namespace

std::vector<QuirkFile> quirk_files() {
    std::vector<QuirkFile> all = columns();
    for (const auto& group : {headers(), named_layouts(), text_forms()})
        all.insert(all.end(), group.begin(), group.end());
    return all;
}
