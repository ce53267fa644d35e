// Stiffness against pressure of a profile given as an array of heights, here read from standard input.
#include <cstdio>
#include <iostream>
#include <iterator>
#include <rugosa/contact.hpp>

int main() {
    const std::vector<double> heights(std::istream_iterator<double>(std::cin), {}); // mm
    const rough::Response response = respond(rough::profile_of(heights, 0.004));    // 0.004 mm apart
    for (rough::Index j = 0; j < response.steps(); ++j)
        std::printf("%.17g,%.17g\n", response.pressure[j], response.tangent_stiffness[j]);
}
