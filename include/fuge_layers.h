/* fuge - frictionless elastic contact: coated and layered bodies. */
