#pragma once

#include "ga/ga.hpp"
