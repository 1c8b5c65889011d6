#include "ocean/sea.h"
