

#include "domain/target/target.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

/// y = 2 + x^2 at five points, defined over [0, 5].
Curve bent() {
    Curve curve{Eigen::VectorXd::LinSpaced(5, 1, 5), Eigen::VectorXd(5), 0, 5};
    curve.y = 2 + curve.x.array().square();
    return curve;
}

} // namespace

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
