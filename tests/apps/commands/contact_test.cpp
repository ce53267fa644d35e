#include "tests/apps/results.hpp"

#include <cmath>

using namespace app::testing;
using nlohmann::json;

TEST_CASE("a measured map is pressed, described and imitated on the cells of --nodes", "[map]") {
    const Folder folder;
    folder.write("map.txt", table_text(32, 28, [](int i, int j) { return std::cos(0.2 * i + 0.15 * j) + 0.01 * i; }));
    const std::string map = " map.txt --spacing 1 --unit um ";
    const auto pressed = [&](const std::string& nodes) {
        const Ended ended = done(folder, "contact --surface" + map + "--reach 0.3 --force --out c.csv " + nodes);
        CHECK((ended.out.find("resampled to") != std::string::npos) == !nodes.empty());
        CHECK_THAT(ended.out, Catch::Contains("0.0320 x 0.0280 mm"));
        return rows_of(folder / "c.csv").back();
    };
    const auto as_measured = pressed("");
    for (const char* nodes : {"--nodes 64x56", "--nodes 24x21"}) {
        INFO(nodes);
        CHECK(pressed(nodes)[1] == Approx(as_measured[1]).epsilon(0.02));
    }
    done(folder, "profile --surface" + map + "--nodes 16x16 --out p");
    const json described = json_in(folder / "p/surface.json");
    CHECK(described["nodes"] == json{16, 16});
    CHECK(described["length_mm"][0].get<double>() == Approx(0.032));

    const std::string like = "design --pipeline 'own 1 | score' --pictures off --force --like" + map;
    const json own = result_of(folder, like), coarse = result_of(folder, like + "--nodes 16x16");
    CHECK(own["nodes"] == json{32, 28});
    CHECK(coarse["nodes"] == json{16, 16});
    CHECK(coarse["targets"] == own["targets"]); // of the points as measured
}

TEST_CASE("layers of the body's modulus leave the curve, a thin one on a rigid base is stiffer") {
    const Folder folder;
    folder.write("g.json", one_wave);
    const auto pressed = [&](const std::string& flags) {
        done(folder,
             "contact --genome g.json --out c.csv --force --kernel periodic --modulus 7 --poisson 0.3 " + flags);
        return rows_of(folder / "c.csv");
    };
    const auto plain = pressed(""), same = pressed("--layer 0.1 --layer 0.2:7:0.3"),
               listed = pressed("--layer 0.1,0.2:7:0.3"), thin = pressed("--layer 0.02 --base rigid");
    for (std::size_t j = 0; j < plain.size(); ++j) {
        CHECK(same[j][1] == Approx(plain[j][1]).epsilon(1e-10));
        CHECK(listed[j] == same[j]);
        CHECK(thin[j][1] > 2 * plain[j][1]);
    }
}

TEST_CASE("a hardness caps pressures and is reported, and friction adds a table of partial slip") {
    const Folder folder;
    folder.write("g.json", one_wave);
    const Ended rubbed = done(folder, "contact --genome g.json --friction 0.3 --out c.csv --verbose");
    CHECK_THAT(rubbed.out, Catch::Contains("c-slip.csv: partial slip under the last load, f = 0.300; assumed"));
    const auto normal = rows_of(folder / "c.csv"),
               slip = rows_of(folder / "c-slip.csv", "tangential_displacement_mm,tangential_traction_MPa,"
                                                     "tangential_stiffness_MPa_per_mm,stick_fraction");
    REQUIRE(slip.size() == 21);
    CHECK(slip[20][1] == Approx(0.3 * normal[19][1]));
    CHECK(slip[0][3] == 1);

    const Ended hard = done(folder, "contact --genome g.json --hardness 0.05 --out h.csv");
    CHECK_THAT(hard.out, Catch::Contains("is the hardness"));
    const auto held = rows_of(folder / "h.csv");
    CHECK(held[19][1] < normal[19][1]);
    const json account = json_in(folder / "h.json");
    CHECK(account["nodes_at_hardness"] > 0);
}

TEST_CASE("the page of a curve shows pressure and gap, links to the files and is not replaced") {
    const Folder folder;
    folder.write("one wave.json", one_wave);
    const Ended ended = done(folder, "contact --genome 'one wave.json' --nodes 128 --pressures 0.1,0.2 --friction 0.3 "
                                     "--out 'a curve.csv' --report page.html");
    const std::string page = rough::read_whole(folder / "page.html");
    for (const char* part : {"href=\"a%20curve.csv\"", "href=\"a%20curve.json\"", "href=\"a%20curve-slip.csv\"",
                             "no --modulus or --material given"})
        CHECK_THAT(page, Catch::Contains(part));
    done(folder, "report 'a curve.json' --out again.html");
    check_refused(rugosa("report 'a curve.json' --out again.html", folder.path()), "set --force");
    check_refused(rugosa("report 'a curve.json' --out './a curve.json' --force", folder.path()),
                  "is a result and would be overwritten");
    CHECK(rough::read_whole(folder / "again.html") == page);
    done(folder, "contact --genome 'one wave.json' --out b.csv --report page.html --force");
    std::filesystem::remove(folder / "b.csv");
    std::filesystem::remove(folder / "b.json");
    check_refused(rugosa("contact --genome 'one wave.json' --out b.csv --report page.html", folder.path()),
                  "page.html");
    check_refused(rugosa("contact --genome 'one wave.json' --out b.csv --report no/page.html", folder.path()), "no");
    CHECK_FALSE(std::filesystem::exists(folder / "b.csv"));
}

TEST_CASE("contact keeps to its accuracy and reports what was modelled") {
    const Folder folder;
    folder.write("g.json", genome_text(1, 1.1, 1.7, {{1, {0.3}}, {2, {4.1}}, {3, {2.2}}, {5, {5.0}}}));
    done(folder, "contact --genome g.json --nodes 4097 --out fine.csv");
    done(folder, "contact --genome g.json --accuracy 1e-2 --out cheap.csv");
    const auto fine = rows_of(folder.path() / "fine.csv", curve_header);
    const auto cheap = rows_of(folder.path() / "cheap.csv", curve_header);
    REQUIRE(cheap.size() == 20);
    for (std::size_t j = 0; j < 20; ++j) {
        CHECK(cheap[j][0] == Approx(fine[j][0]).epsilon(1e-12));
        CHECK(std::abs(cheap[j][1] - fine[j][1]) <= 1e-2 * std::max(fine[j][1], 0.01 * fine.back()[1]));
    }
    const json exact = json_in(folder.path() / "fine.json");
    CHECK(exact["accuracy"].is_null());
    CHECK(exact["nodes"] == 4097);
    const json account = json_in(folder.path() / "cheap.json");
    CHECK(account["resolved_nodes"] == 4097);
    CHECK(account["nodes"] < 4097);
    CHECK(account["estimated_error"] <= 1e-2);
    CHECK(account["chromosomes"]["used"].size() + account["chromosomes"]["dropped"].size() == 4);
    CHECK_THAT(account["words"].get<std::string>(), Catch::Contains("extrapolated to 4097 nodes"));
}

TEST_CASE("the curve of a scan has a band, that of a genome has none") {
    const Folder folder;
    folder.write("g.json", one_wave);
    const auto height = [](int i) { return std::cos(0.7 * i) + 0.5 * std::cos(0.11 * i) + 0.3 * std::sin(1.9 * i); };
    folder.write("scan.txt", heights_text(300, height));
    const std::string press = "contact --profile scan.txt --unit um --spacing 1 --force --out c.csv ";
    const std::string header = curve_header + ",contact_fraction_low,contact_fraction_high,"
                                              "tangent_stiffness_low_MPa_per_mm,tangent_stiffness_high_MPa_per_mm";
    done(folder, press + "--to-pressure 0.001 --report page.html");
    for (const auto& row : rows_of(folder / "c.csv", header)) {
        CHECK((row[6] <= row[2] && row[2] <= row[7]));
        CHECK((row[8] <= row[3] && row[3] <= row[9]));
        CHECK(row[6] < row[7]);
    }
    const json of = json_in(folder / "c.json");
    const std::string words = of["resolution"]["words"];
    const std::string page = rough::read_whole(folder / "page.html");
    for (const std::string& part : {words, std::string("This is line contact"), std::string("The shaded band")})
        CHECK_THAT(page, Catch::Contains(part));

    const Ended off = done(folder, press + "--resolution off --report page.html");
    CHECK_THAT(off.out, Catch::Contains("band not computed"));
    CHECK_THAT(rough::read_whole(folder / "page.html"), Catch::Contains("The band was not computed"));
    const std::string table = rough::read_whole(folder / "c.csv");
    CHECK(table.starts_with(header + "\n"));
    CHECK(table.ends_with(",,,,\n"));
    done(folder, "contact --genome g.json --out curve.csv");
    rows_of(folder / "curve.csv", curve_header);
    check_refused(rugosa(press + "--resolution some", folder.path()), "--resolution");
}

TEST_CASE("contact, profile and design warn of contact spots that are not resolved at half of the loads") {
    const Folder folder;
    const auto write_scan = [&](double wavelength) { // in nodes
        const auto height = [&](int i) { return std::cos(2 * M_PI * i / wavelength) + 0.2 * std::cos(0.037 * i); };
        folder.write("scan.txt", heights_text(1000, height));
    };
    const std::string scan = "scan.txt --unit um --spacing 1 --force --out c";
    const auto warns = [&](const std::string& command, const std::string& page) {
        const Ended ended = answered(rugosa(command, folder.path()));
        const bool shown = ended.out.find("arning: contact spots are not resolved") != std::string::npos;
        CHECK(shown == (rough::read_whole(folder / page).find("contact spots are not resolved") != std::string::npos));
        return shown;
    };
    const auto contact = [&](const std::string& loads) {
        const bool shown = warns("contact --report page.html " + loads + " --profile " + scan + ".csv", "page.html");
        CHECK(json_in(folder / "c.json")["resolution"]["is_resolved"] == !shown);
        return shown;
    };
    write_scan(250); // resolved except under the lightest loads
    CHECK(contact("--pressures 1e-8,2e-8,0.002"));
    CHECK_FALSE(contact("--pressures 1e-8,0.002,0.003"));
    CHECK_FALSE(warns("profile --profile " + scan, "c/report.html"));
    write_scan(3);
    CHECK(warns("profile --profile " + scan, "c/report.html"));
    CHECK(warns("design --nodes 128 --pipeline 'own 1 | score' --like " + scan, "c/report.html"));
}

TEST_CASE("contact takes a material's elasticity and warns beyond its hardness or of outliers") {
    const Folder folder;
    folder.write("g.json", one_wave);
    const auto last = [&](const std::string& flags) {
        done(folder, "contact --genome g.json --force --out c.csv " + flags);
        return rows_of(folder / "c.csv").back()[3];
    };
    CHECK(last("") * 210000 / 0.91 == Approx(last("--modulus 210000 --poisson 0.3")).epsilon(1e-9)); // E*
    CHECK(last("--material steel") == last("--modulus 210000 --poisson 0.3"));
    CHECK(last("--material steel --modulus 1000") == last("--modulus 1000 --poisson 0.3"));
    check_refused(rugosa("contact --genome g.json --out n.csv --material stel", folder.path()), "steel");

    const auto clean = [](int i) { return std::cos(0.05 * i) + 0.01 * std::sin(7. * i); };
    const auto spiked = [&](int i) { return clean(i) + (i == 120 || i == 121 ? 5 : 0); };
    folder.write("clean.txt", heights_text(500, clean));
    folder.write("spiked.txt", heights_text(500, spiked));
    const auto said = [&](const std::string& flags) {
        return done(folder, "contact --unit um --spacing 1 --resolution off --force --out c.csv --profile " + flags)
            .out;
    };
    const std::string carry = "warning: outliers carry the contact", ends = "warning: elastic theory is not valid from";
    CHECK_THAT(said("spiked.txt"), Catch::StartsWith(carry));
    CHECK(said("spiked.txt --outliers remove").find(carry) == std::string::npos);
    CHECK(said("clean.txt").find("warning") == std::string::npos);

    const auto map = [](bool is_spiked) {
        std::string text;
        for (int j = 0; j < 40; ++j)
            for (int i = 0; i < 50; ++i)
                text += std::to_string(std::cos(0.3 * i + 0.2 * j) + 0.1 * std::sin(7. * i * j) +
                                       (is_spiked && (i == 20 || i == 21) && j == 30 ? 9 : 0)) +
                        (i < 49 ? ' ' : '\n');
        return text;
    };
    folder.write("map.txt", map(false));
    folder.write("spikes.txt", map(true));
    const auto of_map = [&](const std::string& flags) {
        return done(folder, "contact --unit um --spacing 1x1 --steps 5 --force --out c.csv --surface " + flags).out;
    };
    CHECK_THAT(of_map("spikes.txt --resolution off"),
               Catch::Contains(carry) && Catch::Contains("2 outliers (from row 31, column 21) kept"));
    CHECK_THAT(of_map("spikes.txt --outliers remove"),
               Catch::Contains("2 outliers (from row 31, column 21) replaced by Laplace's equation") &&
                   !Catch::Contains(carry));
    const double removed = rows_of(folder / "c.csv").back()[1];
    CHECK(of_map("map.txt").find("outlier") == std::string::npos);
    CHECK(rows_of(folder / "c.csv").back()[1] == Approx(removed).epsilon(0.05));
    CHECK_THAT(said("clean.txt --material copper"), Catch::StartsWith(ends) && Catch::Contains("hardness of copper"));
    CHECK(said("clean.txt --material copper --hardness 369").find(ends) == std::string::npos);
    CHECK(said("clean.txt --material copper --to-pressure 1").find(ends) == std::string::npos);
}

TEST_CASE("the page of a map shows its contact spots, which a table lists") {
    const Folder folder;
    folder.write("m.txt", "0 1 0 0\n0 0 0 0.9\n0 0 0 0\n0.8 0 0 0\n"); // three separate peaks
    done(folder, "contact --surface m.txt --spacing 1 --steps 2 --reach 0.5 --out c.csv --report c.html");
    CHECK(rows_of(folder / "c-spots.csv").size() == 3);
    const std::string page = rough::read_whole(folder / "c.html");
    CHECK(found(page, "(<image)").size() == 3); // heights, and the pressure of two steps
    done(folder, "report c.json --out again.html");
    CHECK(rough::read_whole(folder / "again.html") == page);
}

TEST_CASE("one line replaces a map of parallel ridges within an accuracy, which is reported") {
    const Folder folder;
    folder.write("g.json", one_wave);
    const std::string common = "contact --genome g.json --kernel periodic --steps 5 ";
    done(folder, common + "--nodes 40 --out line.csv");
    const Ended area = done(folder, common + "--nodes 40x16 --length 0.84942x0.1 --accuracy 1e-3 --out area.csv");
    CHECK_THAT(area.out, Catch::Contains("One profile, the mean along the grooves, replaces the map"));
    const auto of_area = rows_of(folder / "area.csv"), of_line = rows_of(folder / "line.csv");
    for (std::size_t j = 0; j < 5; ++j)
        for (const std::size_t column : {0u, 1u, 2u, 3u})
            CHECK(of_area[j][column] == Approx(of_line[j][column]).epsilon(1e-6));
    CHECK(rows_of(folder / "area-spots.csv")[0][0] == Approx(of_line[4][2] * 640));
    CHECK_THAT(rough::read_whole(folder / "area.json"), Catch::Contains("\"by_line\": true"));
    const auto crossed = [](int i, int j) { return std::cos(i * M_PI / 6) * (std::cos(j * M_PI / 6) + 0.1); };
    folder.write("map.txt", table_text(12, 12, crossed));
    const Ended map = done(folder, "contact --surface map.txt --spacing 1 --kernel periodic --reach 0.05 --steps 4 "
                                   "--accuracy 0.01 --out m.csv");
    CHECK_THAT(map.out, Catch::Contains("could not replace the map"));
}
