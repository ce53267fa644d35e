#include "domain/scan/scan.hpp"

#include "tests/fuzz/reader.hpp"

/// The first byte sets the options, so the seeds begin with it.
FUZZ(scan) {
    if (bytes.empty()) return;
    rough::ScanOptions options;
    options.fill = bytes[0] & 1;
    options.spacing = bytes[0] & 2 ? 0.001 : 0;
    options.unit = bytes[0] & 4 ? "um" : "";
    options.nodes = {bytes[0] & 8 ? 16 : 0};
    rough::open_scan(fuzz::as_file(bytes.substr(1)), options);
}
