#include "domain/mwm/sampling.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/solid.hpp"
#include "domain/profile/spectrum.hpp"
#include "domain/scan/map.hpp"
#include "domain/scan/scan.hpp"
#include "tests/apps/results.hpp"

using namespace app::testing;

namespace {

const std::string genome = genome_text(0.02, 0.8, 1.5, {{1, {0.3}}, {2, {2.1, 4.4}}, {4, {5.5}}});

} // namespace

TEST_CASE("profile writes heights, solid, pictures, roughness and spectra of a genome") {
    const Folder folder;
    folder.write("surface.json", genome);
    const Ended ended = done(folder, "profile surface.json --nodes 700 --magnify 100");
    CHECK_THAT(ended.out, Catch::Contains("3 waves") && Catch::Contains("Pz"));
    // 84.9 mm by a quarter of it; the base is a tenth of the length, or the relief if that is larger.
    CHECK_THAT(ended.out, Catch::Contains("the printed solid is 84.9 x 21.2 x ") &&
                              Catch::Contains("layer steps of 0.05 mm") && Catch::Contains("by 100,"));
    const auto out = folder / "out" / "surface";

    const rough::Genome read = rough::read_genome(folder / "surface.json");
    const rough::Profile profile = sample(read, {.nodes = 700});
    const auto heights = rows_of(out / "heights.csv", "x_mm,height_mm");
    REQUIRE(heights.size() == 700);
    for (const std::size_t i : {0U, 123U, 699U}) {
        CHECK(heights[i][0] == Approx(double(i) * profile.spacing));
        CHECK(heights[i][1] == profile.heights[rough::Index(i)]);
    }
    const auto numbers = json_in(out / "profile.json");
    CHECK(numbers["Pz_mm"].get<double>() == roughness(profile)["Pz"]);
    CHECK(numbers["PSm_mm"].is_null()); // one long wave has no whole element
    CHECK(numbers["Pk_mm"].get<double>() == roughness(profile)["Pk"]);
    CHECK_FALSE(numbers.contains("Ra_mm"));
    CHECK(numbers["lambda_c_mm"].is_null());
    CHECK(rough::open_scan(out / "profile.x3p", {.detrend = rough::Detrend::none})
              .measured.heights.isApprox(profile.heights, 1e-14));
    CHECK(rough::read_whole(out / "profile.3mf") == three_mf(profile, {.magnify = 100}));
    CHECK(rough::read_whole(out / "profile.png") == height_image(profile).png);
    CHECK(json_in(out / "profile-scale.json")["lowest_height_mm"] == profile.heights.minCoeff());
    const auto bearing = rows_of(out / "bearing.csv", "material_ratio,height_mm");
    CHECK(bearing.size() == 700);
    CHECK(bearing.front()[1] == profile.heights.maxCoeff());
    const std::string page = rough::read_whole(out / "report.html");
    CHECK_THAT(page, Catch::Contains("href=\"profile.3mf\"") && !Catch::Contains("No picture"));
    done(folder, "report out/surface --out again.html");
    CHECK(rough::read_whole(folder / "again.html") == page);
    CHECK(numbers["m4_per_mm2"].get<double>() == roughness(profile)["m4"]);
    CHECK(numbers["m2"].get<double>() == Approx(numbers["series"]["m2"].get<double>()).epsilon(0.5));
    CHECK(rows_of(out / "lines.csv", "wave_number_rad_per_mm,power_mm2").size() == 3);
    CHECK(rows_of(out / "spectrum.csv", "wave_number_rad_per_mm,density_mm3")[17][1] ==
          continuous_spectrum(profile).density[17]);
    CHECK(std::filesystem::file_size(out / "profile.stl") == 84 + 50 * (8 * 699 + 4));
    CHECK(std::system(
              ("admesh '" + (out / "profile.stl").string() + "' | grep -Eq 'Number of parts +: +1 '").c_str()) == 0);
    for (const char* picture : {"profile.svg", "spectrum.svg"})
        CHECK_THAT(rough::read_whole(out / picture),
                   Catch::StartsWith("<?xml") && Catch::Contains("<svg") && Catch::Contains("</svg>"));
}

TEST_CASE("a SUR file is left out, with a note, if its numbers cannot hold the heights") {
    const Folder folder;
    std::string heights;
    for (int i = 0; i < 40; ++i) heights += std::to_string(i % 7) + "e-40\n";
    folder.write("tiny.txt", heights);
    const Ended ended = done(folder, "profile --profile tiny.txt --spacing 0.1 --pictures off --out o");
    CHECK_THAT(ended.out, Catch::Contains("note: profile.sur is left out") && Catch::Contains("check the unit"));
    CHECK_FALSE(std::filesystem::exists(folder / "o/profile.sur"));
    CHECK(json_in(folder / "o/profile.json")["files"].dump().find("profile.sur") == std::string::npos);
}

TEST_CASE("a filtered scan has Ra, an unfiltered one Pa, and outliers are reported") {
    const Folder folder;
    const auto height = [](int i) { return std::cos(2 * M_PI * i / 100) + (i == 1203 ? 9 : 0); };
    folder.write("scan.csv", profile_text("x [mm];z [um]", 2501, 0.002, height));
    const auto numbers = [&](const std::string& flags) {
        const Ended ended = done(folder, "profile --profile scan.csv --pictures off --force --out r " + flags);
        CHECK_THAT(ended.out, Catch::Contains("1 outlier (at x = 2.406 mm)"));
        return json_in(folder / "r" / "profile.json");
    };
    const auto filtered = numbers("--outliers remove --lambda-c 0.8 --lambda-s 0.0025");
    CHECK(filtered["sections"] == 6);
    CHECK(filtered["section_length_mm"] == 0.8);
    CHECK(filtered["lambda_s_mm"] == 0.0025);
    CHECK_FALSE(filtered.contains("Pa_mm"));
    for (const char* file : {"lines.csv", "profile.svg"}) CHECK_FALSE(std::filesystem::exists(folder / "r" / file));
    const double kept = 1 - std::pow(2, -16); // transmission for a quarter of the cut-off wavelength
    CHECK(filtered["Ra_mm"].get<double>() == Approx(2e-3 / M_PI * kept).epsilon(2e-3));
    CHECK(filtered["Rz_mm"].get<double>() == Approx(2e-3 * kept).epsilon(4e-3));
    CHECK(filtered["RSm_mm"].get<double>() == Approx(0.2).epsilon(1e-3));
    CHECK(numbers("")["Pt_mm"].get<double>() > 8e-3);
    CHECK(numbers("--outliers remove")["Pt_mm"].get<double>() == Approx(2e-3).epsilon(1e-2));
}

TEST_CASE("a genome designed for a scan keeps the length of the scan in all commands") {
    const Folder folder;
    const auto height = [](int i) { return std::cos(0.05 * i) + 0.3 * std::cos(0.31 * i); };
    folder.write("scan.txt", profile_text("x [um];z [um]", 401, 0.5, height));
    const auto result = result_of(folder, "design --like scan.txt --quantity stiffness --nodes 128 --pictures off "
                                          "--pipeline 'sample 5 | score | best 1'");
    const auto file = rough::read_genome_file(folder / "r" / "genome.json");
    CHECK(file.length == Approx(0.2));
    CHECK(result["length_mm"].get<double>() == file.length);
    done(folder, "profile r/genome.json --pictures off --out solid");
    const auto numbers = json_in(folder / "solid" / "profile.json");
    CHECK(numbers["length_mm"].get<double>() == Approx(file.length));
    done(folder, "contact --genome r/genome.json --nodes 128 --out own.csv");
    done(folder,
         "contact --genome r/genome.json --nodes 128 --length " + std::to_string(file.length) + " --out given.csv");
    const auto own = rows_of(folder / "own.csv", curve_header), given = rows_of(folder / "given.csv", curve_header);
    for (std::size_t i = 0; i < own.size(); ++i) CHECK(own[i][1] == Approx(given[i][1]).epsilon(1e-4));
}

TEST_CASE("profile writes ISO 25178 parameters, heights, tile and pictures of a map") {
    const Folder folder;
    // grooves along y on a tilted plane, 40 x 24 nodes of 10 x 20 um
    const auto height = [](int i, int j) { return 2 * std::cos(2 * M_PI * i / 10) + 0.3 * i - 0.1 * j; };
    folder.write("map.txt", table_text(40, 24, height));
    const Ended ended = done(folder, "profile --surface map.txt --unit um --spacing 10x20 --magnify 100 --out o");
    CHECK_THAT(ended.out, Catch::Contains("40 x 24") && Catch::Contains("plane removed") && Catch::Contains("Sq") &&
                              Catch::Contains("Std"));
    const auto numbers = json_in(folder / "o" / "surface.json");
    CHECK(numbers["Sq_mm"].get<double>() == Approx(2e-3 / std::sqrt(2)).epsilon(0.02));
    CHECK(numbers["Std_degrees"] == 90);
    CHECK(numbers["Str_is_bound"] == true);
    CHECK(numbers["nodes"] == nlohmann::json({40, 24}));
    for (const std::string file :
         {"heights.svg", "surface.stl", "surface.3mf", "bearing.csv", "spectrum.csv", "spectrum.svg"})
        CHECK(std::filesystem::file_size(folder / "o" / file) > 100);
    // The written matrix and X3P have the same parameters.
    for (const std::string source : {"o/heights.txt --spacing 0.01x0.02 --out a", "o/surface.x3p --out b"}) {
        const Ended again = done(folder, "profile --detrend none --pictures off --surface " + source);
        const auto same =
            nlohmann::json::parse(rough::read_whole(folder / source.substr(source.size() - 1) / "surface.json"));
        for (const char* key : {"Sa_mm", "Sq_mm", "Sdq", "Sal_mm", "Sk_mm"})
            CHECK(same[key].get<double>() == Approx(numbers[key].get<double>()).epsilon(1e-9));
    }
}

TEST_CASE("profile describes a genome on a 2-D grid as a map, with the requested ratios") {
    const Folder folder;
    folder.write("g.json", genome);
    const Ended ended = done(folder, "profile g.json --nodes 40x30 --length 0.8x0.6 --smr 0,-1e-5 --smc 0.1,0.9 "
                                     "--magnify 100 --out o");
    CHECK_THAT(ended.out,
               Catch::Contains("40 x 30 nodes on 0.8") && Catch::Contains("Smc(10 %)") && Catch::Contains("Smc(90 %)"));
    const auto numbers = json_in(folder / "o" / "surface.json");
    CHECK(numbers["nodes"] == nlohmann::json({40, 30}));
    CHECK(numbers["spacing_mm"][1].get<double>() == Approx(0.6 / 30));
    CHECK(numbers["Smr_of_heights"][0]["material_ratio"] == numbers["Smr"]);
    CHECK(numbers["Smr_of_heights"][1]["material_ratio"].get<double>() >= numbers["Smr"].get<double>());
    CHECK(numbers["Smc_of_ratios"][0]["height_mm"] == numbers["Smc10_mm"]);
    CHECK(numbers["Smc_of_ratios"][1]["height_mm"].get<double>() < 0);
    // Its heights are those that contact presses.
    rough::GenomeFile file = rough::read_genome_file(folder / "g.json");
    rough::Grid grid{40, 0.8};
    grid.rows = 30;
    grid.width = 0.6;
    const rough::Scan back = rough::read_map(
        folder / "o" / "heights.txt", {.spacing = 0.8 / 40, .row_spacing = 0.6 / 30, .detrend = rough::Detrend::none});
    CHECK((back.measured.heights - sample(file.genome, grid).heights).cwiseAbs().maxCoeff() < 1e-15);
    CHECK(std::filesystem::file_size(folder / "o" / "surface.stl") == 84 + 50 * 4 * (42 * 32 - 1));
}
