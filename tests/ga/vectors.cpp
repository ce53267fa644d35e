#include "tests/ga/vectors.hpp"

#include "ga/text/compiled_once.hpp"

GA_PIPELINES_HERE(Vectors)
