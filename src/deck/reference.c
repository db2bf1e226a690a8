#include "deck/deck.h"
