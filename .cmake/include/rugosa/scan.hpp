#pragma once

#include "domain/scan/map.hpp"
#include "domain/scan/scan.hpp"
