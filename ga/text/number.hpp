#pragma once

#include "ga/number.hpp"
