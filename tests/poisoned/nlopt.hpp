#error "included without need"
