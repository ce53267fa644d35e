#pragma once

#include "domain/domain.hpp"
