#include "ga/base/random.hpp"

int main() { return ga::Stream(1).uniform(0, 1) < 1 ? 0 : 1; }
