#include "domain/errors.hpp"
#include "domain/target/target.hpp"
#include "tests/catch.hpp"
#include "tests/folder.hpp"

using namespace rough;

namespace {

Target read_text(const std::string& text, const TargetScales& scales = {}) {
    const tests::Folder folder;
    return read_target(folder.write("target.csv", text), scales);
}

/// y = 2 + x^2 at five points, defined over [0, 5].
Curve bent() {
    Curve curve{Eigen::VectorXd::LinSpaced(5, 1, 5), Eigen::VectorXd(5), 0, 5};
    curve.y = 2 + curve.x.array().square();
    return curve;
}

} // namespace

TEST_CASE("the columns of a target file determine its quantity") {
    CHECK(read_text("pressure_MPa,stiffness_MPa_per_mm\n1,2\n3,4\n").quantity == Quantity::stiffness);
    CHECK(read_text("pressure_MPa,contact_fraction\n1,0.2\n").quantity == Quantity::area_at_pressure);
    CHECK(read_text("displacement_mm,contact_fraction\n1,0.2\n").quantity == Quantity::area_at_displacement);
    CHECK(read_text("displacement_mm,pressure_MPa\n1,0.2\n").quantity == Quantity::load_at_displacement);
    CHECK(read_text("pressure_MPa,interface_stiffness_MPa_per_mm\n1,2\n").quantity == Quantity::interface_stiffness);
    const Target swapped = read_text("stiffness_MPa_per_mm , pressure_MPa\n2,1\n4,3\n");
    CHECK(swapped.x == Eigen::Vector2d(1, 3));
    CHECK(swapped.y == Eigen::Vector2d(2, 4));
}

TEST_CASE("a conductance is read as the interface stiffness with that conductance") {
    // C = 2 K_i/(E* rho) in SI units: K_i (N/m^3) = C E* rho/2, and 1 MPa/mm is 1e9 N/m^3.
    const TargetScales scales{.effective_modulus = 78554, .resistivity = 0.01, .thermal_resistivity = 2.0 / 167};
    for (const auto& [column, per_unit] : {std::pair("conductance_S_per_m2", 78554e6 * 0.01 / 2 / 1e9),
                                           {"conductance_W_per_m2K", 78554e6 * (2.0 / 167) / 2 / 1e9}}) {
        const std::string text = std::string("pressure_bar,") + column + ",lower,upper\n1,897.6,800,900\n";
        const Target target = read_text(text, scales);
        CHECK(target.quantity == Quantity::interface_stiffness);
        CHECK(target.x[0] == Approx(0.1));
        CHECK(target.y[0] == Approx(897.6 * per_unit));
        CHECK(target.lower[0] == Approx(800 * per_unit));
        CHECK(target.upper[0] == Approx(900 * per_unit));
        const Target again = read_text(to_csv(target), scales); // written as it was read
        CHECK(columns_of(again).y == column);
        CHECK(again.y[0] == Approx(target.y[0]).epsilon(1e-15));
        CHECK_THROWS_WITH(read_text(text), Catch::Contains("of both bodies; give a "));
    }
    CHECK_THROWS_WITH(read_text("pressure_MPa,conductance\n1,10\n", scales), Catch::Contains("give it a unit"));
    CHECK_THROWS_WITH(conductance_columns(scales), Catch::Contains("give either"));
}

TEST_CASE("a target in other units equals the target in the usual units") {
    const TargetScales on_map{.nominal_area = 4, .shear_strength = 0.2}; // mm^2, MPa
    const auto same = [&](const std::string& text, const std::string& usual) {
        CAPTURE(text);
        const Target a = read_text(text, on_map), b = read_text(usual);
        CHECK(a.quantity == b.quantity);
        CHECK(a.x.isApprox(b.x, 1e-15));
        CHECK(a.y.isApprox(b.y, 1e-15));
        CHECK(a.has_band() == b.has_band());
        CHECK((!a.has_band() || (a.lower.isApprox(b.lower, 1e-15) && a.upper.isApprox(b.upper, 1e-15))));
    };
    same("displacement_um,load_N\n1,8\n2,20\n", "displacement_mm,pressure_MPa\n1e-3,2\n2e-3,5\n");
    same("pressure_psi,contact_percent\n1,20\n", "pressure_MPa,contact_fraction\n6.894757293168361e-3,0.2\n");
    same("load_mN,area_um2,lower,upper\n8,4e5,3e5,5e5\n",
         "pressure_MPa,contact_fraction,lower,upper\n2e-3,0.1,0.075,0.125\n");
    same("pressure_kPa,stiffness_GPa_per_m\n3,5\n", "pressure_MPa,stiffness_MPa_per_mm\n3e-3,5\n");
    same("pressure_Pa,interface_stiffness_N_per_nm\n3,8\n", "pressure_MPa,interface_stiffness_MPa_per_mm\n3e-6,2e6\n");
    same("normal_N,friction_mN\n8,40\n", "pressure_MPa,contact_fraction\n2,0.05\n");
    same("pressure_MPa,shear_kPa\n2,10\n", "pressure_MPa,contact_fraction\n2,0.05\n");
    CHECK_THROWS_WITH(read_text("pressure_MPa,shear_MPa\n2,0.1\n"), Catch::Contains("give a shear-strength"));
}

TEST_CASE("a written target is read back to the bit, with its recorded model") {
    Target target = read_text("# kernel: strip\n# datum_mm: 0.84942\npressure_MPa,stiffness_MPa_per_mm,lower,upper\n"
                              "0.1,0.3,0.29,0.31\n0.2,0.7,0.6,0.8\n");
    CHECK(target.recorded.at("kernel") == "strip");
    CHECK(target.recorded.at("datum_mm") == "0.84942");
    target.x[0] = 0.1 + 1e-17;
    target.y[1] = 2.0 / 3;
    const Target again = read_text(to_csv(target));
    CHECK(again.x == target.x);
    CHECK(again.y == target.y);
    CHECK(again.lower == target.lower);
    CHECK(again.recorded == target.recorded);
}

TEST_CASE("a target reads alike with commas, semicolons, tabs and decimal commas, and after a mark") {
    const std::string names = "pressure_MPa,stiffness_MPa_per_mm";
    for (const std::string& text :
         {names + "\n1e-6,0.5\n2.5e-6,1.25\n", "\xEF\xBB\xBF" + names + "\r\n1e-6, 0.5\r\n2.5e-6,1.25\r\n",
          std::string("pressure_MPa;stiffness_MPa_per_mm\n1e-6;0,5\n2,5e-6;1,25\n"),
          std::string("pressure_MPa;stiffness_MPa_per_mm\n1e-6;0.5\n2.5e-6;1.25\n"),
          std::string("pressure_MPa\tstiffness_MPa_per_mm\n1e-6\t0,5\n2,5e-6\t1.25\n\n")}) {
        INFO(text);
        const Target target = read_text(text);
        REQUIRE(target.points() == 2);
        CHECK(target.x == Eigen::Vector2d(1e-6, 2.5e-6));
        CHECK(target.y == Eigen::Vector2d(0.5, 1.25));
    }
}

TEST_CASE("a bad target is refused by file, line and column") {
    using Catch::Contains;
    const std::string stiffness = "pressure_MPa,stiffness_MPa_per_mm";
    const std::vector<std::array<std::string, 3>> bad{
        {"pressure_MPa\n1\n", "pressure_MPa", "not a target"},
        {stiffness + "\n1,x\n", ":2:", "\"x\""},
        {"pressure_MPa;contact_fraction\n\n1;nan\n", ":3:", "\"nan\""},
        {stiffness + "\n1,2\n0,5,1\n", ":3: \"0,5,1\"", "give 2 numbers"},
        {stiffness + "\n1,2\n1,3\n", "point 2", "pressure_MPa"},
        {stiffness + "\n1,-2\n", "stiffness_MPa_per_mm is -2", "greater than 0"},
        {"pressure_MPa,contact_fraction\n1,1.5\n", "contact_fraction is 1.5", "at most 1"},
        {stiffness + ",contact_fraction\n1,2,0.5\n", "more than one curve", "one per file"},
        {stiffness + ",lower\n1,2,1\n", "lower", "not a target"},
        {stiffness + ",lower,upper\n1,2,2.5,3\n", "point 1", "lower is 2.5"},
        {stiffness + "\n", "no points", ""},
        {"pressure_torr,contact_fraction\n1,0.2\n", "\"pressure_torr\"", "Pa, kPa, MPa, GPa, bar or psi"},
        {"displacement_um,load_N\n1,8\n", "\"load_N\"", "a profile has no area"}};
    for (const auto& [text, place, problem] : bad)
        CHECK_THROWS_WITH(read_text(text), Contains("target.csv") && Contains(place) && Contains(problem));
}

TEST_CASE("a misfit is 0 within the band, and beyond it the distance to the band") {
    const auto each = [](double value) { return Eigen::VectorXd::Constant(3, value); };
    Target target{Quantity::stiffness, "", Eigen::Vector3d(1, 2, 3), each(10), each(8), each(11)};
    const Curve curve{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(9, 12, 7), 0, 3};
    CHECK(misfit(target, curve).isApprox(Eigen::Vector3d(0, 0.1, -0.1), 1e-12));
    CHECK(similarity(target, curve) == Approx(0.9));
    target.weight = 0.5;
    CHECK(similarity(target, curve) == Approx(0.95));
    target.lower.resize(0), target.upper.resize(0), target.weight = 1;
    CHECK(similarity(target, curve) == Approx(0.7));
}

TEST_CASE("a curve is compared with a reference at equal shares of their highest pressures") {
    const Curve reference = bent();
    CHECK(similarity(reference, reference) == 1);
    CHECK(similarity(reference, stretched(reference, 3)) == Approx(1));
    CHECK(similarity(stretched(reference, 0.1), reference) == Approx(1));
    Curve one_off = reference;
    one_off.y[3] *= 1.07;
    CHECK(similarity(reference, one_off) == Approx(1 - 0.07));
    CHECK(similarity(one_off, reference) == Approx(1 - 0.07 / 1.07));
    one_off.y[1] *= 0.8;
    CHECK(similarity(reference, stretched(one_off, 2)) == Approx(0.8));
}
