#include "domain/errors.hpp"
#include "domain/target/similarity.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

Target read_text(const std::string& text, const TargetScales& scales = {}) {
    const tests::Folder folder;
    return read_target(folder.write("target.csv", text), scales);
}

} // namespace

TEST_CASE("a target file says by its columns what it is of") {
    CHECK(read_text("pressure_MPa,stiffness_MPa_per_mm\n1,2\n3,4\n").quantity == Quantity::stiffness);
    CHECK(read_text("pressure_MPa,contact_fraction\n1,0.2\n").quantity == Quantity::area_at_pressure);
    CHECK(read_text("displacement_mm,contact_fraction\n1,0.2\n").quantity == Quantity::area_at_displacement);
    CHECK(read_text("displacement_mm,pressure_MPa\n1,0.2\n").quantity == Quantity::load_at_displacement);
    CHECK(read_text("pressure_MPa,interface_stiffness_MPa_per_mm\n1,2\n").quantity ==
          Quantity::interface_stiffness);
    const Target swapped = read_text("stiffness_MPa_per_mm , pressure_MPa\n2,1\n4,3\n");
    CHECK(swapped.x == Eigen::Vector2d(1, 3));
    CHECK(swapped.y == Eigen::Vector2d(2, 4));
}

TEST_CASE("a conductance is read as the interface stiffness that has it") {
    // C = 2 K_i/(E* rho): K_i = C E* rho/2
    const Target target =
        read_text("pressure_MPa,conductance,lower,upper\n1,10,8,12\n", {.conductance_to_stiffness = 0.25});
    CHECK(target.quantity == Quantity::interface_stiffness);
    CHECK(target.y[0] == 2.5);
    CHECK(target.lower[0] == 2);
    CHECK(target.upper[0] == 3);
    CHECK_THROWS_WITH(read_text("pressure_MPa,conductance\n1,10\n"),
                      Catch::Contains("expected a resistivity"));
}

TEST_CASE("a target in other units is the one in the usual units") {
    const TargetScales on_map{.nominal_area = 4}; // mm^2
    const auto same = [&](const std::string& text, const std::string& usual) {
        CAPTURE(text);
        const Target a = read_text(text, on_map), b = read_text(usual);
        CHECK(a.quantity == b.quantity);
        CHECK(a.x.isApprox(b.x, 1e-15));
        CHECK(a.y.isApprox(b.y, 1e-15));
        CHECK(a.lower.size() == b.lower.size());
        CHECK(
            (a.lower.size() == 0 || (a.lower.isApprox(b.lower, 1e-15) && a.upper.isApprox(b.upper, 1e-15))));
    };
    same("displacement_um,load_N\n1,8\n2,20\n", "displacement_mm,pressure_MPa\n1e-3,2\n2e-3,5\n");
    same("load_mN,area_um2,lower,upper\n8,4e5,3e5,5e5\n",
         "pressure_MPa,contact_fraction,lower,upper\n2e-3,0.1,0.075,0.125\n");
    same("pressure_kPa,stiffness_GPa_per_m\n3,5\n", "pressure_MPa,stiffness_MPa_per_mm\n3e-3,5\n");
    same("pressure_Pa,interface_stiffness_N_per_nm\n3,8\n",
         "pressure_MPa,interface_stiffness_MPa_per_mm\n3e-6,2e6\n");
}

TEST_CASE("a target written is read back to the bits, with what it records of its model") {
    Target target =
        read_text("# kernel: strip\n# datum_mm: 0.84942\npressure_MPa,stiffness_MPa_per_mm,lower,upper\n"
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

TEST_CASE("bad targets are refused by file, line and column") {
    using Catch::Contains;
    CHECK_THROWS_WITH(read_text("pressure_MPa\n1\n"), Contains("pressure_MPa") && Contains("expected"));
    CHECK_THROWS_WITH(read_text("pressure_MPa,stiffness_MPa_per_mm\n1,x\n"),
                      Contains(":2:") && Contains("\"x\""));
    CHECK_THROWS_WITH(read_text("pressure_MPa,stiffness_MPa_per_mm\n1,2\n1,3\n"), Contains("point 2"));
    CHECK_THROWS_WITH(read_text("pressure_MPa,stiffness_MPa_per_mm\n1,-2\n"), Contains("greater than 0"));
    CHECK_THROWS_WITH(read_text("pressure_MPa,contact_fraction\n1,1.5\n"), Contains("at most 1"));
    CHECK_THROWS_WITH(read_text("pressure_MPa,stiffness_MPa_per_mm,contact_fraction\n1,2,0.5\n"),
                      Contains("more than one curve given, expected one a file"));
    CHECK_THROWS_WITH(read_text("pressure_MPa,stiffness_MPa_per_mm,lower\n1,2,1\n"), Contains("lower"));
    CHECK_THROWS_WITH(read_text("pressure_MPa,stiffness_MPa_per_mm,lower,upper\n1,2,2.5,3\n"),
                      Contains("lower"));
    CHECK_THROWS_WITH(read_text("pressure_MPa,stiffness_MPa_per_mm\n"), Contains("no points"));
    CHECK_THROWS_WITH(read_text("pressure_psi,contact_fraction\n1,0.2\n"),
                      Contains("\"pressure_psi\"") && Contains("Pa, kPa, MPa or GPa"));
    CHECK_THROWS_WITH(read_text("displacement_um,load_N\n1,8\n"),
                      Contains("\"load_N\"") && Contains("a profile has no area"));
}

TEST_CASE("a misfit within the band counts for nothing, beyond it for its distance") {
    Target target;
    target.x = Eigen::Vector3d(1, 2, 3);
    target.y = Eigen::Vector3d(10, 10, 10);
    target.lower = Eigen::Vector3d(8, 8, 8);
    target.upper = Eigen::Vector3d(11, 11, 11);
    const Curve curve{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(9, 12, 7), 0, 3};
    CHECK(misfit(target, curve).isApprox(Eigen::Vector3d(0, 0.1, -0.1), 1e-12));
    CHECK(similarity(target, curve) == Approx(0.9));
    target.weight = 0.5;
    CHECK(similarity(target, curve) == Approx(0.95));
    target.lower.resize(0), target.upper.resize(0), target.weight = 1;
    CHECK(similarity(target, curve) == Approx(0.7));
}
